// The status as the page gets it: a picture of the machine as JSON text.
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
    /// Notes on the motion thread what only that may look at; gives what makes the text, in any thread.
    std::function<std::string(const operate::Status&)> writer(PanelContext& desk) const;

  private:
    struct Facts;
    std::shared_ptr<const Facts> facts_;
};

}  // namespace motionrack::panel
