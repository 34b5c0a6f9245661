// Every session that a program linked with motionrack_c_sessions opens by motionrack/c.h is under the laws of sessions.
#pragma once

namespace motionrack::test {

/// Number of sessions opened so far, copies included.
int sessions_under_laws();

}  // namespace motionrack::test
