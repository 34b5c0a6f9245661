// Handles the messages of a WebSocket client and queues answers, events and snapshots for it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/frontends/server/client.hpp>
#include <utility>

namespace motionrack::server {

using auth::Role;
using nlohmann::json;

namespace {

constexpr double min_rate = 1, max_rate = 100, first_rate = 10;
constexpr int policy = 1008, try_again = 1013;  // WebSocket close codes (RFC 6455, 7.4)

std::chrono::nanoseconds period_of(double rate_hz) {
    return std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / rate_hz));
}

/// Returns a message without these members; the others are the fields of the command or query.
json without(json object, std::initializer_list<const char*> names) {
    for (const char* name : names) object.erase(name);
    return object;
}

}  // namespace

Client::Client(PanelService& service, Peer peer, std::string session, MessageSink& wire)
    : service_(service),
      peer_(std::move(peer)),
      session_(std::move(session)),
      wire_(&wire),
      messages_(service.settings().limits.messages_at_once, service.settings().limits.messages_per_second),
      period_(period_of(first_rate)),
      next_(service.now().steady),
      opened_at_(next_),
      looked_after_(next_) {}

Role Client::role() const {
    if (token_id_.empty()) return service_.role_without_token(peer_);
    return service_.door().role_of(token_id_, service_.now().wall);
}

void Client::allow_for(Role role) {
    const Limits& limits = service_.settings().limits;
    if (wire_ == nullptr) return;
    wire_->allow(role >= Role::operate ? limits.big_body : role >= Role::observe ? limits.frame : limits.strange_frame);
}

void Client::opened() {
    allow_for(role());
    const ServerSettings& settings = service_.settings();
    const json hello = {{"hello",
                         {{"version", settings.version},
                          {"rack", settings.rack},
                          {"boot", settings.boot},
                          {"role", auth::name_of(role())},
                          {"user", user_},
                          {"session", panel::session_mark(session_)},
                          {"simulation", true}}}};
    send({panel::text_of(hello), nullptr});
}

// ---- incoming

void Client::message(std::string_view text, bool is_text) {
    if (leaving_) return;
    if (!is_text)
        return refuse(nullptr, 400, "invalid_input", "Messages must be text; this one was binary. Nothing was done.");
    const bool counted = messages_.take("", service_.now().steady);
    // A message of up to 200 bytes that may be STOP is parsed above the rate limit, too.
    if (!counted && (text.size() > 200 || text.find("\"stop\"") == std::string_view::npos))
        return refuse(nullptr, 429, "limit",
                      fmt::format("More than {:g} messages a second were received. This one was not read; send fewer.",
                                  service_.settings().limits.messages_per_second));
    Result<json> object = read_object(text, "The message");
    if (!object) return answer(nullptr, panel::error_answer(object.error()));
    Request request;
    if (object->contains("id")) request.id = std::move((*object)["id"]);
    if (!(request.id.is_null() || request.id.is_number_integer() ||
          (request.id.is_string() && request.id.get_ref<const std::string&>().size() <= 64)))
        return refuse(nullptr, 400, "invalid_input",
                      "The id of a message is a whole number or a text of at most 64 bytes. Nothing was done.");
    const auto says = [&](const char* what) { return object->contains(what) && (*object)[what].is_string(); };
    // The former key is "order"; STOP is executed under it, too, because STOP is never refused.
    const bool former = says("order") && !says("command");
    if (former && (*object)["order"] != "stop")
        return refuse(request.id, 400, "invalid_input", "'order' is now 'command'. Nothing was done.");
    if (former) (*object)["command"] = "stop";
    if (says("command")) {
        const std::string name = (*object)["command"];
        if (name == "stop") {
            service_.stop(caller(), peer_.address);
            return answer(request.id, panel::done());
        }
        if (!counted)
            return refuse(request.id, 429, "limit", "Too many messages were received. Nothing was done; send fewer.");
        request.fields = without(std::move(*object), {"id", "command"});
        return ask(request, name, false);
    }
    if (!counted)
        return refuse(request.id, 429, "limit", "Too many messages were received. Nothing was done; send fewer.");
    if (says("query")) {
        const std::string name = (*object)["query"];
        request.fields = without(std::move(*object), {"id", "query"});
        return ask(request, name, true);
    }
    request.fields = std::move(*object);
    if (request.fields.contains("token")) return token(request);
    if (request.fields.contains("subscribe")) return subscribe(request);
    refuse(request.id, 400, "invalid_input",
           "A message has one of token, subscribe, command, query. Nothing was done.");
}

void Client::token(const Request& request) {
    const json& token = request.fields["token"];
    const auto who = service_.authenticate(token.is_string() ? token.get<std::string>() : "", peer_);
    if (!who) return refuse(request.id, 401, "denied", who.error().sentence);
    user_ = who->user;
    token_id_ = who->id;
    seen_ = true;
    allow_for(who->role);
    answer(request.id, panel::done({{"role", auth::name_of(who->role)}, {"user", who->user}}));
}

void Client::subscribe(const Request& request) {
    const json& wanted = request.fields["subscribe"];
    const auto wrong = [&](std::string sentence) {
        refuse(request.id, 400, "invalid_input", std::move(sentence) + " Nothing was subscribed.");
    };
    if (role() == Role::none)
        return refuse(request.id, 401, "denied",
                      "A remote client needs a token. Send it first: {\"id\":1,\"token\":\"..\"}.");
    if (!wanted.is_object()) return wrong("subscribe requires {\"channels\":[..],\"rate_hz\":20}.");
    double rate = first_rate;
    std::vector<std::string> names;
    for (const auto& [key, value] : wanted.items()) {
        if (key == "rate_hz") {
            if (!value.is_number()) return wrong("rate_hz must be a number.");
            rate = value.get<double>();
        } else if (key == "channels") {
            if (!value.is_array()) return wrong("channels must be a list of names.");
            if (value.size() > panel::Panel::max_channels)
                return wrong(fmt::format("{} channels are too many; the limit is {}.", value.size(),
                                         panel::Panel::max_channels));
            for (const json& name : value) {
                if (!name.is_string()) return wrong("channels must be a list of names.");
                names.push_back(name);
            }
        } else {
            return wrong("subscribe accepts only channels and rate_hz.");
        }
    }
    if (!(rate >= min_rate && rate <= max_rate))
        return wrong(fmt::format("rate_hz is {:g}; it must be {:g} to {:g}.", rate, min_rate, max_rate));
    const std::int64_t number = ++newest_subscription_;
    const auto take = [this, number, rate, id = request.id](std::shared_ptr<panel::ChannelSet> set) {
        if (number == newest_subscription_) {
            channels_ = std::move(set);
            period_ = period_of(rate);
            next_ = service_.now().steady;
        }
        answer(id, panel::done());
    };
    if (names.empty()) return take(nullptr);
    service_.panel().subscribe(std::move(names), [self = weak_from_this(), post = service_.post(), take,
                                                  id = request.id](Result<std::shared_ptr<panel::ChannelSet>> set) {
        (*post)([self, take, id, set = std::move(set)] {
            const auto client = self.lock();
            if (!client) return;
            if (!set) return client->answer(id, panel::error_answer(set.error()));
            take(*set);
        });
    });
}

void Client::ask(const Request& request, const std::string& name, bool query) {
    const panel::OperationSpec* row = panel::find_row(name);
    if (row == nullptr || query != is_query(*row))
        return refuse(request.id, 404, "invalid_input", panel::unknown_operation(query ? "query" : "command", name));
    if (asks_ >= service_.settings().limits.asks_waiting)
        return refuse(
            request.id, 429, "limit",
            fmt::format(
                "{} commands and queries wait for their answers, which is the limit. Nothing was done; wait for some.",
                asks_));
    ++asks_;
    service_.ask(caller(), peer_.address, *row, request.fields,
                 [self = weak_from_this(), id = request.id](panel::Answer done) {
                     const auto client = self.lock();
                     if (!client) return;
                     --client->asks_;
                     client->answer(id, std::move(done));
                 });
}

// ---- outgoing

void Client::answer(const json& id, panel::Answer answer) {
    answer.body["id"] = id;
    send({panel::text_of(answer.body), nullptr});
}

void Client::refuse(const json& id, int status, std::string_view trouble, std::string sentence) {
    answer(id, panel::refused_answer(status, trouble, std::move(sentence)));
}

void Client::send(OutgoingMessage message) {
    if (leaving_ || wire_ == nullptr) return;
    const Limits& limits = service_.settings().limits;
    if (!message.picture &&
        queue_.size() - pictures_ >= (token_id_.empty() ? limits.strange_texts_waiting : limits.texts_waiting))
        return close_with_reason(try_again, "Answers and events were not read; connect again.");
    pictures_ += message.picture;
    queue_.push_back(std::move(message));
    if (queue_.size() == 1) wire_->write(queue_.front());
}

void Client::written() {
    if (queue_.empty()) return;
    pictures_ -= queue_.front().picture;
    queue_.pop_front();
    if (!queue_.empty() && wire_ != nullptr && !leaving_) wire_->write(queue_.front());
}

void Client::closed() {
    wire_ = nullptr;
    leaving_ = true;
    service_.left(session_);
}

void Client::close_with_reason(int code, std::string_view reason) {
    if (std::exchange(leaving_, true) || wire_ == nullptr) return;
    wire_->close(code, reason);
}

// ---- time

bool Client::due(Time now) {
    if (leaving_ || now < next_ || (token_id_.empty() && service_.role_without_token(peer_) == Role::none))
        return false;
    const auto passed = (now - next_) / period_ + 1;  // more than one if the thread was late
    next_ += passed * period_;
    periods_ += passed;
    const bool is_queued = pictures_ < service_.settings().limits.pictures_waiting;
    lost_ += passed - is_queued;
    return is_queued;
}

void Client::send_picture(std::shared_ptr<const std::string> rest) {
    send({fmt::format("{{\"seq\":{},\"lost\":{},", periods_, std::exchange(lost_, 0)), std::move(rest), true});
}

void Client::send_event(std::shared_ptr<const std::string> text) {
    if (token_id_.empty() && service_.role_without_token(peer_) == Role::none) return;
    send({"", std::move(text)});
}

void Client::check_session(Time now) {
    if (leaving_ || now - looked_after_ < std::chrono::milliseconds(500)) return;
    looked_after_ = now;
    const Role mine = role();
    seen_ = seen_ || mine != Role::none;
    if (mine != Role::none) return;
    if (seen_)
        close_with_reason(policy, "The token has expired or was revoked; pair again.");
    else if (now - opened_at_ > service_.settings().limits.header)
        close_with_reason(policy, "No token came.");
}

}  // namespace motionrack::server
