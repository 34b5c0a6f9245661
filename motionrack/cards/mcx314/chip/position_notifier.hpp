// Notifies the listeners to the axes' positions of changed rates and of watched counts that are passed.
#pragma once

#include <motionrack/base/time.hpp>
#include <motionrack/cards/mcx314/chip/edge_stream.hpp>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/motion_law.hpp>
#include <motionrack/cards/mcx314/chip/pulse_listeners.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

class PositionNotifier {
  public:
    PositionNotifier(State& state, EventRequests& requests, const MotionLaw& law, const PulseListeners& listeners,
                     EdgeStream& edges)
        : state_(state), requests_(requests), law_(law), listeners_(listeners), edges_(edges) {}

    /// Updates, before an event, the rates last sent to listeners: along an arc they drift between the reported
    /// changes.
    void note_rates();
    /// Delivers, after an event, the edges, the changed rates and the watched counts that were passed.
    void notify(Instant now);

  private:
    State& state_;
    EventRequests& requests_;
    const MotionLaw& law_;
    const PulseListeners& listeners_;
    EdgeStream& edges_;
};

}  // namespace motionrack::mcx314
