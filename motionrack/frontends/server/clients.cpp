// Sends snapshots and events to all WebSocket clients.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <motionrack/frontends/server/clients.hpp>

namespace motionrack::server {

namespace {

std::string encoded(const panel::StatusSnapshot& picture, const panel::Values* values) {
    std::string out =
        fmt::format("\"at\":{},\"status\":{},\"values\":[", to_seconds(picture.at()), picture.status_text());
    if (values != nullptr) {
        const char* comma = "";
        for (const double number : values->numbers) {
            if (std::isfinite(number))
                fmt::format_to(std::back_inserter(out), "{}{}", comma, number);
            else
                fmt::format_to(std::back_inserter(out), "{}null", comma);
            comma = ",";
        }
    }
    return out + "]}";
}

}  // namespace

void Clients::add(std::shared_ptr<Client> client) {
    clients_.push_back(std::move(client));
    count_ = static_cast<std::int64_t>(clients_.size());
}

void Clients::remove(const Client* client) {
    std::erase_if(clients_, [&](const std::shared_ptr<Client>& one) { return one.get() == client; });
    count_ = static_cast<std::int64_t>(clients_.size());
}

std::shared_ptr<const std::string> Clients::encode(const std::shared_ptr<panel::ChannelSet>& set,
                                                   const std::shared_ptr<const panel::StatusSnapshot>& picture) {
    Encoded& kept = encoded_[set.get()];
    const std::shared_ptr<const panel::Values> values = set ? set->newest() : nullptr;
    const bool same_set = set ? kept.set.lock() == set : true;
    if (!kept.text || !same_set || kept.picture != picture || kept.values != values)
        kept = {set, picture, values, std::make_shared<const std::string>(encoded(*picture, values.get()))};
    return kept.text;
}

void Clients::tick() {
    const auto now = service_.now().steady;
    const std::shared_ptr<const panel::StatusSnapshot> picture = service_.panel().picture();
    const std::vector<std::shared_ptr<Client>> clients = clients_;  // copied, because a closed client leaves the list
    for (const std::shared_ptr<Client>& client : clients) {
        client->check_session(now);
        if (!client->due(now)) continue;
        client->send_picture(encode(client->channels(), picture));
    }
    std::erase_if(encoded_, [](const auto& one) { return one.first != nullptr && one.second.set.expired(); });
}

void Clients::notify(const panel::Event& event) {
    const auto text = std::make_shared<const std::string>(panel::text_of({{"event", panel::to_json(event)}}));
    const std::vector<std::shared_ptr<Client>> clients = clients_;
    for (const std::shared_ptr<Client>& client : clients) client->send_event(text);
}

}  // namespace motionrack::server
