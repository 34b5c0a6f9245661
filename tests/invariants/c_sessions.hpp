// Programs linked with motionrack_c_sessions check the laws of sessions in every session that they open by
// motionrack/c.h.
#pragma once

namespace motionrack::test {

/// Returns the number of sessions opened so far, including copies.
int sessions_under_laws();

}  // namespace motionrack::test
