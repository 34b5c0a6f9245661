// Pairing and token lookup.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <motionrack/auth/authenticator.hpp>
#include <motionrack/auth/secrets.hpp>

namespace motionrack::auth {

namespace {

tl::unexpected<AuthError> deny(AuthError::Why why, std::string sentence) {
    return tl::unexpected<AuthError>(AuthError{why, std::move(sentence)});
}

bool may_be_in_a_name(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80 || (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') ||
           (byte >= 'a' && byte <= 'z') || c == '.' || c == '-' || c == '_' || c == ' ';
}

}  // namespace

std::string name_problem(std::string_view name) {
    if (name.empty() || name.size() > 40) return fmt::format("A name has 1 to 40 bytes, this one has {}.", name.size());
    if (name.front() == ' ' || name.back() == ' ') return "A name must not begin or end with a blank.";
    if (!std::all_of(name.begin(), name.end(), may_be_in_a_name))
        return "A name may have letters, digits, dots, dashes, underscores and blanks.";
    return "";
}

Authenticator::Authenticator(AuthSettings settings)
    : settings_(std::move(settings)),
      wrong_(settings_.failed_burst, settings_.wrong_per_second),
      all_wrong_(settings_.all_wrong_at_once, settings_.all_wrong_per_second) {}

Result<std::unique_ptr<Authenticator>> Authenticator::open(AuthSettings settings) {
    std::unique_ptr<Authenticator> made(new Authenticator(std::move(settings)));
    MOTIONRACK_CHECK(made->read());
    if (made->settings_.on_start_code) {
        made->start_code_ = random_code();
        made->settings_.on_start_code(made->start_code_);
    }
    return made;
}

bool Authenticator::has(std::string_view name) const {
    return std::any_of(tokens_.begin(), tokens_.end(), [&](const Token& token) { return token.identity.user == name; });
}

AuthResult<Authenticator::Paired> Authenticator::admit(std::string_view name, Role role, WallTime now) {
    std::vector<Token> before = tokens_;
    std::erase_if(tokens_, [&](const Token& token) { return token.identity.expires <= now; });
    if (tokens_.size() >= settings_.max_tokens) {
        const std::size_t there = tokens_.size();
        tokens_ = std::move(before);
        return deny(AuthError::Why::failed,
                    fmt::format("Not paired: the limit of {} paired devices is reached. Revoke a user first.", there));
    }
    Paired paired;
    paired.token = random_token();
    Token token;
    token.hash = hash_of(paired.token);
    const auto whole =
        std::chrono::time_point_cast<std::chrono::seconds>(now + settings_.token_life);  // precision of the file
    token.identity = {id_of(token.hash), std::string(name), role, whole};
    paired.identity = token.identity;
    tokens_.push_back(std::move(token));
    if (const Result<void> written = write(); !written) {
        tokens_ = std::move(before);
        return deny(AuthError::Why::failed, "Not paired: " + written.error().message);
    }
    return paired;
}

AuthResult<Authenticator::Paired> Authenticator::pair(std::string_view code, std::string_view name,
                                                      std::string_view address, Timestamps now) {
    const std::lock_guard<std::mutex> alone(lock_);
    if (!wrong_.there_is(address, now.steady) || !all_wrong_.there_is("all", now.steady))
        return deny(AuthError::Why::too_many,
                    "Too many wrong codes were received. This one was not checked; wait some seconds and try again.");
    if (const std::string problem = name_problem(name); !problem.empty())
        return deny(AuthError::Why::wrong, "Not paired: " + problem);
    std::erase_if(invitations_, [&](const Invitation& one) { return one.expires <= now.steady; });
    const std::string plain = plain_code(code), hash = hash_of(plain);
    if (!start_code_.empty() && same_secret(hash, hash_of(plain_code(start_code_)))) {
        AuthResult<Paired> paired = admit(name, Role::maintain, now.wall);
        if (paired) {
            start_code_ = random_code();
            settings_.on_start_code(start_code_);
        }
        return paired;
    }
    const auto invitation = std::find_if(invitations_.begin(), invitations_.end(),
                                         [&](const Invitation& one) { return same_secret(one.hash, hash); });
    if (invitation == invitations_.end()) {
        wrong_.take(address, now.steady);
        all_wrong_.take("all", now.steady);
        return deny(
            AuthError::Why::wrong,
            "Not paired: this code is not valid. It was mistyped, used already, or has expired; ask for another.");
    }
    if (has(name))
        return deny(AuthError::Why::wrong,
                    fmt::format("Not paired: {} is paired already. Choose another name, or have {} revoked first.",
                                name, name));
    AuthResult<Paired> paired = admit(name, invitation->role, now.wall);
    if (paired) invitations_.erase(invitation);
    return paired;
}

Result<std::string> Authenticator::invite(Role role, Timestamps now) {
    const std::lock_guard<std::mutex> alone(lock_);
    if (role == Role::none)
        return fail(ErrorKind::invalid_input,
                    "No invitation was created: the roles are observe, operate and maintain.");
    std::erase_if(invitations_, [&](const Invitation& one) { return one.expires <= now.steady; });
    if (invitations_.size() >= settings_.max_invitations)
        return fail(ErrorKind::refused, fmt::format("No invitation was created: the limit of {} open invitations is "
                                                    "reached. Wait until one is used or expires.",
                                                    invitations_.size()));
    const std::string code = random_code();
    invitations_.push_back({hash_of(plain_code(code)), role, now.steady + settings_.invitation_life});
    return code;
}

Result<void> Authenticator::revoke(std::string_view name) {
    const std::lock_guard<std::mutex> alone(lock_);
    std::vector<Token> before = tokens_;
    if (std::erase_if(tokens_, [&](const Token& token) { return token.identity.user == name; }) == 0)
        return fail(ErrorKind::refused, fmt::format("The user {} is not paired. Nothing was changed.", name));
    const Result<void> written = write();
    if (!written) tokens_ = std::move(before);
    return written;
}

Result<void> Authenticator::forget(std::string_view id) {
    const std::lock_guard<std::mutex> alone(lock_);
    std::vector<Token> before = tokens_;
    if (std::erase_if(tokens_, [&](const Token& token) { return token.identity.id == id; }) == 0)
        return fail(ErrorKind::refused, "This token is not known. Nothing was changed.");
    const Result<void> written = write();
    if (!written) tokens_ = std::move(before);
    return written;
}

AuthResult<Identity> Authenticator::authenticate(std::string_view token, WallTime now) const {
    const std::string hash = hash_of(token);
    const std::lock_guard<std::mutex> alone(lock_);
    for (const Token& one : tokens_) {
        if (!same_secret(one.hash, hash)) continue;
        if (one.identity.expires <= now)
            return deny(AuthError::Why::wrong, "The token has expired. Pair again with a new code.");
        return one.identity;
    }
    return deny(
        AuthError::Why::wrong,
        "The token is not known here: it was revoked, or belongs to another machine. Pair again with a new code.");
}

Role Authenticator::role_of(std::string_view id, WallTime now) const {
    const std::lock_guard<std::mutex> alone(lock_);
    for (const Token& one : tokens_)
        if (one.identity.id == id) return one.identity.expires <= now ? Role::none : one.identity.role;
    return Role::none;
}

std::vector<Identity> Authenticator::users() const {
    const std::lock_guard<std::mutex> alone(lock_);
    std::vector<Identity> out;
    for (const Token& one : tokens_) out.push_back(one.identity);
    return out;
}

std::string Authenticator::start_code() const {
    const std::lock_guard<std::mutex> alone(lock_);
    return start_code_;
}

}  // namespace motionrack::auth
