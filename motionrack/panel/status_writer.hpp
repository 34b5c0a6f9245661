// Status of the machine as JSON text for the page.
#pragma once

#include <functional>
#include <memory>
#include <motionrack/operate/machine.hpp>
#include <string>

namespace motionrack::panel {

struct PanelContext;

class StatusWriter {
  public:
    explicit StatusWriter(operate::Machine& machine);
    /// Collects on the motion thread the data reserved to it; returns a function that creates the text in any thread.
    std::function<std::string(const operate::Status&)> writer(PanelContext& context) const;

  private:
    struct Facts;
    std::shared_ptr<const Facts> facts_;
};

}  // namespace motionrack::panel
