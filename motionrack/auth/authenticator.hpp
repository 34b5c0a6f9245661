// Authentication: pairing codes are exchanged for tokens; a token identifies its caller.
//
//  start code (printed, maintain) ─┐                    ┌─► users file: name, role, hash of the token, expiry
//  invitation (by a maintainer) ───┴─ code + name ─► token ─► identity, until it expires or is revoked
//
// Any thread. Every call takes a short lock; calls that change users write the users file. The caller passes the times.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <motionrack/auth/rate_limit.hpp>
#include <motionrack/auth/role.hpp>
#include <motionrack/base/result.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace motionrack::auth {

using WallTime = std::chrono::system_clock::time_point;

/// Readings of both clocks at one instant: times in files use the wall clock, limits use the steady clock.
struct Timestamps {
    WallTime wall;
    std::chrono::steady_clock::time_point steady;
};

struct AuthSettings {
    std::filesystem::path users_file = {};  ///< empty: kept in memory only
    std::chrono::minutes invitation_life{10};
    std::chrono::hours token_life{90 * 24};
    std::size_t max_tokens = 500, max_invitations = 50;
    double failed_burst = 5, wrong_per_second = 0.1;          ///< wrong codes per address
    double all_wrong_at_once = 60, all_wrong_per_second = 1;  ///< wrong codes of all addresses
    /// Receives the code that lets the first user in, now and after each use; empty: none is open.
    std::function<void(const std::string&)> on_start_code = {};
};

/// Owner of a token.
struct Identity {
    std::string id;  ///< token id; not a secret
    std::string user;
    Role role = Role::none;
    WallTime expires;
};

/// Reason for a rejection.
struct AuthError {
    enum class Why : std::uint8_t {
        wrong,
        too_many,
        failed
    } reason = Why::wrong;  ///< failed: writing the users file failed
    std::string sentence;
};
template <class T>
using AuthResult = tl::expected<T, AuthError>;

class Authenticator {
  public:
    /// Errors: io, invalid_input: the users file cannot be read, is invalid, or is writable by others.
    static Result<std::unique_ptr<Authenticator>> open(AuthSettings settings);

    struct Paired {
        std::string token;  ///< shown only here
        Identity identity;
    };
    /// Exchanges a code for one token. `address`: the caller's; wrong codes are limited per address and in total. An
    /// invitation pairs only new names.
    AuthResult<Paired> pair(std::string_view code, std::string_view name, std::string_view address, Timestamps now);
    /// Returns a code for this role, valid once and for ten minutes. Refused: too many are open, or the role is none.
    Result<std::string> invite(Role role, Timestamps now);
    /// Revokes all tokens of this name. Refused: the name has no token.
    Result<void> revoke(std::string_view name);
    /// Revokes one token by its id. Refused: unknown id.
    Result<void> forget(std::string_view id);

    AuthResult<Identity> authenticate(std::string_view token, WallTime now) const;
    /// Returns the current role of a token id; none if the token was revoked or has expired.
    Role role_of(std::string_view id, WallTime now) const;
    std::vector<Identity> users() const;
    /// Code for a first user who can see the program's output; empty: none is open.
    std::string start_code() const;

  private:
    struct Token {
        Identity identity;
        std::string hash;
    };
    static std::string id_of(const std::string& hash) { return hash.substr(0, 16); }
    struct Invitation {
        std::string hash;
        Role role;
        std::chrono::steady_clock::time_point expires;
    };
    explicit Authenticator(AuthSettings settings);
    Result<void> read();
    Result<void> write() const;
    AuthResult<Paired> admit(std::string_view name, Role role, WallTime now);
    bool has(std::string_view name) const;

    AuthSettings settings_;
    mutable std::mutex lock_;
    std::vector<Token> tokens_;
    std::vector<Invitation> invitations_;
    std::string start_code_;
    RateLimit wrong_, all_wrong_;
};

/// Returns the problem with a user name, or empty. Valid: 1 .. 40 letters, digits, dots, dashes, underscores, and
/// blanks inside.
std::string name_problem(std::string_view name);

}  // namespace motionrack::auth
