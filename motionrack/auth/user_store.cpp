// Users file: JSON, readable only by its owner, replaced as a whole. It contains tokens as hashes.
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <motionrack/auth/authenticator.hpp>
#include <motionrack/auth/private_files.hpp>
#include <motionrack/base/read_whole_file.hpp>
#include <motionrack/disk/new_file.hpp>
#include <nlohmann/json.hpp>
#include <set>

namespace motionrack::auth {

namespace {

std::int64_t seconds_of(WallTime time) {
    return std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
}

bool is_hash(const std::string& text) {
    return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

Result<void> Authenticator::read() {
    const std::string path = settings_.users_file.string();
    struct stat about {};
    if (path.empty()) return {};
    MOTIONRACK_CHECK(check_writers(path, "The users file"));
    if (::stat(path.c_str(), &about) != 0) return {};
    if (!S_ISREG(about.st_mode))
        return fail(ErrorKind::invalid_input, "The users path is not a regular file.", {}, path);
    MOTIONRACK_TRY(const std::string text, read_whole_file(path, read_limits::users));
    const auto damaged = [&](const std::string& why) {
        return fail(ErrorKind::invalid_input,
                    fmt::format("The users file is damaged: {}. Nothing was started; correct it, or remove it and pair "
                                "all users again.",
                                why),
                    {}, path);
    };
    const nlohmann::json file = nlohmann::json::parse(text, nullptr, false);
    if (!file.is_object() || !file.contains("users") || !file["users"].is_array())
        return damaged("it has no list of users");
    std::set<std::string> ids;
    for (const nlohmann::json& one : file["users"]) {
        if (!one.is_object()) return damaged("a user is not an object");
        const auto text_of = [&](const char* key) {
            return one.contains(key) && one[key].is_string() ? one[key].get<std::string>() : std::string();
        };
        const std::string name = text_of("name"), hash = text_of("token_sha256");
        const std::optional<Role> role = role_named(text_of("role"));
        if (const std::string problem = name_problem(name); !problem.empty()) return damaged("a user's name is wrong");
        if (!role || *role == Role::none) return damaged(fmt::format("{} has no role", name));
        if (!is_hash(hash)) return damaged(fmt::format("{} has no token_sha256", name));
        if (!ids.insert(id_of(hash)).second)
            return damaged(fmt::format("{} has the token_sha256 of another user", name));
        if (!one.contains("expires") || !one["expires"].is_number_integer())
            return damaged(fmt::format("{} has no expires", name));
        const std::int64_t expires = one["expires"].get<std::int64_t>();
        if (expires < 0 || expires > 9'000'000'000)
            return damaged(fmt::format("{} has an expires of {}", name, expires));
        tokens_.push_back({{id_of(hash), name, *role, WallTime(std::chrono::seconds(expires))}, hash});
    }
    return {};
}

Result<void> Authenticator::write() const {
    if (settings_.users_file.empty()) return {};
    nlohmann::json users = nlohmann::json::array();
    for (const Token& one : tokens_)
        users.push_back({{"name", one.identity.user},
                         {"role", name_of(one.identity.role)},
                         {"token_sha256", one.hash},
                         {"expires", seconds_of(one.identity.expires)}});
    const std::string text =
        nlohmann::json{{"users", users}}.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    const std::string path = settings_.users_file.string();
    const Result<void> done = disk::write_whole(path, text, disk::Rights::owner);
    if (done) return {};
    return fail(ErrorKind::io,
                fmt::format("the users file {} could not be written: {}. It is as it was.", path, done.error().message),
                {}, path);
}

}  // namespace motionrack::auth
