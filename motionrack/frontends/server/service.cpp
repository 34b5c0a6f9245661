// Passes requests to the panel and returns its answers.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/frontends/server/service.hpp>
#include <motionrack/frontends/server/user_commands.hpp>

namespace motionrack::server {

using auth::Role;
using nlohmann::json;

namespace {

HttpAnswer with(HttpAnswer answer, std::string field, std::string value) {
    answer.more.emplace_back(std::move(field), std::move(value));
    return answer;
}

/// Returns the bearer token of a request; empty: none.
std::string token_of(const RequestHead& head) {
    return head.authorization.substr(0, 7) == "Bearer " ? head.authorization.substr(7) : "";
}

/// Returns true for 16 bytes in base64.
bool is_websocket_key(std::string_view key) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    return key.size() == 24 && key.find_first_not_of(digits) == 22 && key.substr(22) == "==";
}

/// Performs the checks that RFC 6455 (4.2) requires of a server. Returns the error answer, if any.
std::optional<HttpAnswer> refuse_handshake(const RequestHead& head) {
    if (head.websocket_version != "13") {
        HttpAnswer answer = http_error(
            426, "invalid_input",
            fmt::format("The handshake requests version \"{}\" of the WebSocket protocol; only version 13 is "
                        "supported. No WebSocket was opened.",
                        shown(head.websocket_version)));
        return with(with(std::move(answer), "Sec-WebSocket-Version", "13"), "Upgrade", "websocket");
    }
    if (!is_websocket_key(head.websocket_key))
        return http_error(
            400, "invalid_input",
            fmt::format("The Sec-WebSocket-Key \"{}\" is not 16 bytes in base64. No WebSocket was opened.",
                        shown(head.websocket_key)));
    if (head.has_more)
        return http_error(400, "invalid_input",
                          "Bytes follow the handshake, which is not yet answered. No WebSocket was "
                          "opened; wait for the answer.");
    return std::nullopt;
}

}  // namespace

bool is_query(const panel::OperationSpec& row) {
    const auto queries = panel::queries();
    return &row >= queries.data() && &row < queries.data() + queries.size();
}

PanelService::PanelService(ServerSettings settings, panel::Panel& panel, auth::Authenticator& door,
                           auth::ControlLease& lease, Page page, std::shared_ptr<NetworkExecutor> post)
    : settings_(std::move(settings)),
      panel_(panel),
      door_(door),
      lease_(lease),
      page_(std::move(page)),
      guard_(settings_.hosts, settings_.origins),
      post_(std::move(post)),
      requests_(settings_.limits.requests_at_once, settings_.limits.requests_per_second),
      reported_(1, 1),
      unknown_senders_([this](const AuditEntry& entry) {
          if (settings_.audit) settings_.audit(entry);
      }),
      openapi_(panel::Panel::openapi().dump(2) + "\n") {}

// ---- before the body

/// Rejects requests above the limits; applied to every request except STOP.
std::optional<HttpAnswer> PanelService::refuse(const RequestHead& head) {
    if (head.peer.stop_only)
        return http_error(503, "limit",
                          fmt::format("All connections are in use: {} in total, or {} of {}. Only STOP is accepted; "
                                      "close some, or try again.",
                                      settings_.limits.connections, settings_.limits.of_a_network, head.peer.network));
    if (!requests_.take(head.peer.network, now().steady))
        return http_error(
            429, "limit",
            fmt::format("More than {:g} requests a second came from this address. Nothing was done; send fewer.",
                        settings_.limits.requests_per_second));
    return std::nullopt;
}

Admission PanelService::admit(const RequestHead& head) {
    Admission out;
    const auto answer = [&](HttpAnswer one) {
        out.answer = std::move(one);
        return out;
    };
    if (const std::string problem = guard_.problem(head); !problem.empty())
        return answer(http_error(403, "denied", problem));
    const Result<RequestTarget> target = read_target(head.target);
    if (!target) return answer(http_answer(panel::error_answer(target.error())));
    if (target->path == "/api/stop") {
        if (head.method != "POST")
            return answer(with(http_error(405, "invalid_input", "STOP needs the method POST."), "Allow", "POST"));
        panel::Caller caller;
        if (const std::string token = token_of(head); !token.empty())
            if (const auto known = door_.authenticate(token, now().wall)) caller.user = known->user;
        stop(std::move(caller), head.peer.address);
        return answer(http_answer(panel::done()));
    }
    if (auto refused = refuse(head)) return answer(std::move(*refused));
    if (target->path.rfind("/api/", 0) == 0) return admit_api(head, *target);
    return answer(file_answer(page_, head.method, target->path));
}

Admission PanelService::admit_api(const RequestHead& head, const RequestTarget& target) {
    Admission out;
    const auto answer = [&](HttpAnswer one) {
        out.answer = std::move(one);
        return out;
    };
    const std::string name = target.path.substr(5);
    const bool get = head.method == "GET", post = head.method == "POST";
    if (name == "pair") {
        if (!post)
            return answer(with(http_error(405, "invalid_input", "Pairing needs the method POST."), "Allow", "POST"));
        out.body_limit = settings_.limits.strange_body;
        return out;
    }
    if (name == "forget") {
        if (post) return answer(forget(head));
        return answer(
            with(http_error(405, "invalid_input", "Revoking your own token needs the method POST."), "Allow", "POST"));
    }
    if (name == "stream")
        return answer(
            with(http_error(426, "invalid_input", "This address accepts only WebSockets."), "Upgrade", "websocket"));
    out.caller.role = role_without_token(head.peer);
    out.caller.session = std::string("h");
    if (!head.authorization.empty()) {
        const auto who = this->authenticate(token_of(head), head.peer);
        if (!who) return answer(http_error(401, "denied", who.error().sentence));
        out.caller = {who->user, who->role, fmt::format("t{}", who->id)};
    }
    if (out.caller.role == Role::none)
        return answer(
            http_error(401, "denied", "A remote request needs a token. Nothing was done. Pair first: POST /api/pair."));
    if (name == "openapi.json" && get) {
        HttpAnswer document;
        document.body = std::make_shared<const std::string>(openapi_);
        return answer(std::move(document));
    }
    out.row = panel::find_row(name);
    if (out.row == nullptr)
        return answer(http_error(404, "invalid_input", panel::unknown_operation("command or query", name)));
    const bool query = is_query(*out.row);
    if (query ? !get : !post)
        return answer(
            with(http_error(405, "invalid_input",
                            fmt::format("{} is {} with {}.", name, query ? "a query, asked" : "a command, sent",
                                        query ? "GET" : "POST")),
                 "Allow", query ? "GET" : "POST"));
    const bool long_texts =
        std::any_of(out.row->fields.begin(), out.row->fields.end(), [&](const panel::FieldSpec& field) {
            return field.max > static_cast<double>(settings_.limits.small_body) / 2;
        });
    out.body_limit = query                                ? 0
                     : out.caller.role < out.row->role    ? settings_.limits.strange_body
                     : long_texts && is_known(out.caller) ? settings_.limits.big_body
                                                          : settings_.limits.small_body;
    return out;
}

std::optional<HttpAnswer> PanelService::refuse_stream(const RequestHead& head) {
    if (const std::string problem = guard_.problem(head); !problem.empty()) return http_error(403, "denied", problem);
    if (auto refused = refuse(head)) return refused;
    if (head.target != "/api/stream") return http_error(404, "invalid_input", "The WebSocket is at /api/stream.");
    return refuse_handshake(head);
}

// ---- with the body

void PanelService::handle(const RequestHead& head, const Admission& admission, const std::string& body,
                          std::function<void(HttpAnswer)> reply) {
    if (admission.row == nullptr) return reply(pair(head, body));
    const RequestTarget target = *read_target(head.target);
    Result<json> fields = json::object();
    if (head.method == "GET")
        fields = panel::fields_of_texts(*admission.row, target.texts);
    else if (!body.empty())
        fields = read_object(body, "The body");
    if (!fields) return reply(http_answer(panel::error_answer(fields.error())));
    ask(admission.caller, head.peer.address, *admission.row, *fields,
        [reply = std::move(reply)](const panel::Answer& answer) { reply(http_answer(answer)); });
}

HttpAnswer PanelService::pair(const RequestHead& head, const std::string& body) {
    const Result<json> fields = read_object(body, "The body");
    if (!fields) return http_answer(panel::error_answer(fields.error()));
    const auto text = [&](const char* key) {
        return fields->contains(key) && (*fields)[key].is_string() ? (*fields)[key].get<std::string>() : std::string();
    };
    const std::string code = text("code"), name = text("name");
    if (code.empty() || name.empty() || fields->size() != 2)
        return http_error(400, "invalid_input",
                          "Pairing takes {\"code\":\"ABCD-EFGH\",\"name\":\"anna\"}. The pairing was refused.");
    const auto paired = door_.pair(code, name, head.peer.address, now());
    panel::Answer answer;
    if (paired) {
        answer = panel::done({{"token", paired->token},
                              {"role", auth::name_of(paired->identity.role)},
                              {"user", paired->identity.user},
                              {"expires", utc_text(paired->identity.expires)}});
    } else {
        using Why = auth::AuthError::Why;
        const Why why = paired.error().reason;
        answer = why == Why::too_many ? panel::refused_answer(429, "limit", paired.error().sentence)
                 : why == Why::failed ? panel::refused_answer(500, "io", paired.error().sentence)
                                      : panel::refused_answer(403, "denied", paired.error().sentence);
    }
    audit(auth::name_problem(name).empty() ? name : "", head.peer.address, "pair", answer, paired.has_value());
    return http_answer(answer);
}

/// Revokes the token of a browser at its request.
HttpAnswer PanelService::forget(const RequestHead& head) {
    const auto who = this->authenticate(token_of(head), head.peer);
    if (!who) return http_error(401, "denied", who.error().sentence);
    const Result<void> gone = door_.forget(who->id);
    const panel::Answer answer = gone ? panel::done() : panel::error_answer(gone.error());
    audit(who->user, head.peer.address, "forget", answer, true);
    return http_answer(answer);
}

auth::AuthResult<auth::Identity> PanelService::authenticate(const std::string& token, const Peer& peer) {
    auto who = door_.authenticate(token, now().wall);
    if (!who) audit("", peer.address, "token", panel::refused_answer(401, "denied", who.error().sentence), false);
    return who;
}

// ---- commands and queries

void PanelService::ask(panel::Caller caller, const std::string& address, const panel::OperationSpec& row,
                       const json& fields, std::function<void(panel::Answer)> reply) {
    // The motion thread answers queries: many connections together must not overload it.
    if (is_query(row) && !requests_.take("queries of " + network_of(address), now().steady))
        return reply(panel::refused_answer(
            429, "limit",
            fmt::format(
                "More than {:g} queries a second came from this address. The query was not answered; send fewer.",
                settings_.limits.requests_per_second)));
    caller.address = address;
    panel_.ask(
        caller, row.name, fields,
        [this, post = post_, reply = std::move(reply), query = is_query(row), user = caller.user, address,
         passing = row.high_rate, is_known = is_known(caller), what = std::string(row.name)](panel::Answer answer) {
            (*post)([this, reply, query, user, address, passing, is_known, what, answer = std::move(answer)] {
                if (!query && (!passing || answer.status != 200)) audit(user, address, what, answer, is_known);
                reply(answer);
            });
        });
}

void PanelService::stop(panel::Caller caller, const std::string& address) {
    caller.address = address;
    panel_.stop(caller);
    audit(caller.user, address, "stop", panel::done(), !caller.user.empty());
}

void PanelService::left(const std::string& session) {
    panel_.left(session);
    lease_.left(session);
}

/// Skips an equal entry of the same user within a second.
void PanelService::audit(const std::string& user, const std::string& address, std::string what,
                         const panel::Answer& answer, bool is_known) {
    if (!settings_.audit) return;
    const auto at = now().steady;
    if (is_known && !reported_.take(fmt::format("{} {} {} {}", address, what, answer.status, user), at)) return;
    AuditEntry entry{user, address, std::move(what), answer.status, "done"};
    if (answer.status != 200 && answer.body.contains("error"))
        entry.outcome = answer.body["error"].value("message", "");
    if (is_known) return settings_.audit(entry);
    unknown_senders_.add(std::move(entry), network_of(address), at);
}

}  // namespace motionrack::server
