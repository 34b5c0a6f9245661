// Who comes in: pairing codes give tokens, tokens tell who a caller is.
//
//   start code (printed, maintain) ─┐                    ┌─► users file: name, role, hash of the token, until when
//   invitation (maintain gives it) ─┴─ code + name ─► token ─► identity, until it expires or is revoked
//
// Any thread; every call takes a short lock, and those that change users write their file. Times are handed in.
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

/// The two clocks at one instant: what is kept in files counts by the wall's, what limits counts by the steady one.
struct Timestamps {
    WallTime wall;
    std::chrono::steady_clock::time_point steady;
};

struct AuthSettings {
    std::filesystem::path users_file = {};  ///< empty: kept in memory only
    std::chrono::minutes invitation_life{10};
    std::chrono::hours token_life{90 * 24};
    std::size_t max_tokens = 500, max_invitations = 50;
    double failed_burst = 5, wrong_per_second = 0.1;          ///< wrong codes of one address
    double all_wrong_at_once = 60, all_wrong_per_second = 1;  ///< and of all together
    /// Gets the code that lets the first person in, at once and each time that it was used; empty: there is none.
    std::function<void(const std::string&)> on_start_code = {};
};

/// Who a token belongs to.
struct Identity {
    std::string id;  ///< of the token; no secret
    std::string user;
    Role role = Role::none;
    WallTime expires;
};

/// Why somebody was not let in.
struct AuthError {
    enum class Why : std::uint8_t {
        wrong,
        too_many,
        failed
    } reason = Why::wrong;  ///< failed: the users file could not be written
    std::string sentence;
};
template <class T>
using AuthResult = tl::expected<T, AuthError>;

class Authenticator {
  public:
    /// Errors: io, invalid_input: the users file cannot be read, is not one, or others may write it.
    static Result<std::unique_ptr<Authenticator>> open(AuthSettings settings);

    struct Paired {
        std::string token;  ///< told this once
        Identity identity;
    };
    /// A code is good for one token. `address` is where the caller comes from: wrong codes are limited for each and for
    /// all. With an invitation only names that are not there yet can be paired.
    AuthResult<Paired> pair(std::string_view code, std::string_view name, std::string_view address, Timestamps now);
    /// A code that gives this role once, for ten minutes. Refused: too many are open, role nobody.
    Result<std::string> invite(Role role, Timestamps now);
    /// Forgets all tokens of this name. Refused: there is none.
    Result<void> revoke(std::string_view name);
    /// Forgets one token, by its id. Refused: there is none.
    Result<void> forget(std::string_view id);

    AuthResult<Identity> authenticate(std::string_view token, WallTime now) const;
    /// Whether the token of this id still holds: role nobody if it was revoked or has expired.
    Role role_of(std::string_view id, WallTime now) const;
    std::vector<Identity> users() const;
    /// The code that lets somebody in who can see the program's output; empty: there is none.
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

/// What is wrong with a user's name; empty: nothing. 1 .. 40 letters, digits, dots, dashes, underscores and blanks
/// inside.
std::string name_problem(std::string_view name);

}  // namespace motionrack::auth
