// All WebSocket clients: sends the newest snapshot to clients that are due, encoded once per set of channels.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <motionrack/frontends/server/client.hpp>
#include <string>
#include <vector>

namespace motionrack::server {

class Clients {
  public:
    explicit Clients(PanelService& service) : service_(service) {}
    void add(std::shared_ptr<Client> client);
    void remove(const Client* client);
    /// Checks the tokens of all clients and sends due snapshots. The server calls it every 5 ms.
    void tick();
    void notify(const panel::Event& event);
    /// Number of clients; any thread.
    std::int64_t count() const { return count_; }

  private:
    /// Encoded snapshot for all clients with the same set of channels, sent after their own sequence numbers.
    struct Encoded {
        std::weak_ptr<panel::ChannelSet> set;
        std::shared_ptr<const panel::StatusSnapshot> picture;
        std::shared_ptr<const panel::Values> values;
        std::shared_ptr<const std::string> text;
    };
    std::shared_ptr<const std::string> encode(const std::shared_ptr<panel::ChannelSet>& set,
                                              const std::shared_ptr<const panel::StatusSnapshot>& picture);

    PanelService& service_;
    std::vector<std::shared_ptr<Client>> clients_;
    std::map<const panel::ChannelSet*, Encoded> encoded_;  // used for lookup only; its order is never visible
    std::atomic<std::int64_t> count_ = 0;
};

}  // namespace motionrack::server
