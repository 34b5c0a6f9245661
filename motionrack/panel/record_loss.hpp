// What the panel does where the journal fails: the machine holds, and what would begin something is refused.
#pragma once

#include <motionrack/panel/panel_context.hpp>

namespace motionrack::panel {

class RecordLoss {
  public:
    explicit RecordLoss(PanelContext& desk) : desk_(desk) {}
    /// Every slice. The first time that the journal has failed: holds the machine, raises its alarm, and lets no card
    /// begin a list by itself.
    void look();
    /// Errors: refused. What looks, stops, lets go or jogs is taken although it is not recorded.
    Result<void> may(const OperationSpec& row) const;
    /// The answer to an order that was taken, whose entry in the journal is `kept`.
    static Answer answer(const OperationSpec& row, Answer answer, const Result<std::int64_t>& kept);

  private:
    PanelContext& desk_;
    bool lost_ = false;
};

}  // namespace motionrack::panel
