// Reactions of the panel to a journal failure: the machine holds, and starts are refused.
#pragma once

#include <motionrack/panel/panel_context.hpp>

namespace motionrack::panel {

class RecordLoss {
  public:
    explicit RecordLoss(PanelContext& context) : context_(context) {}
    /// Call every slice. On the first failure of the journal: holds the machine, raises its alarm, and prevents cards
    /// from starting lists by themselves.
    void poll();
    /// Checks whether an operation is accepted after a journal failure. Queries, stops, releases and jogs are, although
    /// they are not recorded. Errors: refused.
    Result<void> may(const OperationSpec& row) const;
    /// Returns the answer to an executed command. `kept`: number of its journal entry, or the error of writing it.
    static Answer answer(const OperationSpec& row, Answer answer, const Result<std::int64_t>& kept);

  private:
    PanelContext& context_;
    bool lost_ = false;
};

}  // namespace motionrack::panel
