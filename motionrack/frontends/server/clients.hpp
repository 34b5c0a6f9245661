// All WebSocket clients: who is due gets the newest picture, encoded once for all who look at the same channels.
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
    explicit Clients(Service& service) : service_(service) {}
    void add(std::shared_ptr<Client> client);
    void remove(const Client* client);
    /// Every few ms.
    void tick();
    void tell(const panel::Event& event);
    /// Any thread.
    std::int64_t count() const { return count_; }

  private:
    /// What all who look at one set of channels get, behind their own numbers.
    struct Encoded {
        std::weak_ptr<panel::ChannelSet> set;
        std::shared_ptr<const panel::StatusSnapshot> picture;
        std::shared_ptr<const panel::Values> values;
        std::shared_ptr<const std::string> text;
    };
    std::shared_ptr<const std::string> encode(const std::shared_ptr<panel::ChannelSet>& set,
                                              const std::shared_ptr<const panel::StatusSnapshot>& picture);

    Service& service_;
    std::vector<std::shared_ptr<Client>> clients_;
    std::map<const panel::ChannelSet*, Encoded> encoded_;  // looked up only, never walked to the outside
    std::atomic<std::int64_t> count_ = 0;
};

}  // namespace motionrack::server
