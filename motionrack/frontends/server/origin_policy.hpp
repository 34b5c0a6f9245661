// Which names this computer may be called by, and from which pages it may be asked: what keeps pages from elsewhere
// out, which a browser would let ask in its user's name.
#pragma once

#include <motionrack/frontends/server/http.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::server {

/// "Rack.local:8080" -> "rack.local", "[::1]:80" -> "::1"; empty: no name.
std::string host_name(std::string_view host);

/// What limits are counted for: an IPv4 address, or the 64 bits of an IPv6 address that one customer has,
/// "2001:db8:0:1::/64".
std::string network_of(const std::string& address);

/// Of what a stranger sent, for a sentence: its beginning, without what could disturb a terminal or a journal.
std::string shown(std::string_view text);

class OriginPolicy {
  public:
    OriginPolicy(std::vector<std::string> hosts, std::vector<std::string> origins);
    /// Empty, or the sentence why not. A head without Origin is no browser's page.
    std::string problem(const RequestHead& head) const;

  private:
    bool knows(const std::string& name, const Peer& peer) const;
    std::vector<std::string> hosts_, origins_;
};

}  // namespace motionrack::server
