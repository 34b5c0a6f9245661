// User management commands of a maintainer.
#include <fmt/format.h>

#include <motionrack/frontends/server/user_commands.hpp>

namespace motionrack::server {

using nlohmann::json;

std::string utc_text(auth::WallTime time) {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(time);
    const auto day = std::chrono::floor<std::chrono::days>(seconds);
    const std::chrono::year_month_day date(day);
    const std::chrono::hh_mm_ss clock(seconds - day);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), clock.hours().count(),
                       clock.minutes().count(), clock.seconds().count());
}

std::map<std::string, panel::Handler, std::less<>> door_orders(auth::Authenticator& door) {
    return {{"invite",
             [&door](const panel::Caller&, const json& fields) {
                 const auth::Timestamps now{std::chrono::system_clock::now(), std::chrono::steady_clock::now()};
                 const auto code = door.invite(*auth::role_named(fields["role"].get<std::string>()), now);
                 return code ? panel::done({{"code", *code}}) : panel::error_answer(code.error());
             }},
            {"revoke_user",
             [&door](const panel::Caller&, const json& fields) {
                 const auto gone = door.revoke(fields["user"].get<std::string>());
                 return gone ? panel::done() : panel::error_answer(gone.error());
             }},
            {"users", [&door](const panel::Caller&, const json&) {
                 json users = json::array();
                 for (const auth::Identity& one : door.users())
                     users.push_back(
                         {{"user", one.user}, {"role", auth::name_of(one.role)}, {"expires", utc_text(one.expires)}});
                 return panel::done({{"users", users}});
             }}};
}

}  // namespace motionrack::server
