// Accepted host names of this computer and accepted page origins. Rejects requests that a foreign page makes through
// the user's browser.
#pragma once

#include <motionrack/frontends/server/http.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::server {

/// Returns the name in a Host header: "Rack.local:8080" -> "rack.local", "[::1]:80" -> "::1"; empty: invalid.
std::string host_name(std::string_view host);

/// Key for limits: an IPv4 address, or the 64-bit network of an IPv6 address that one customer has,
/// "2001:db8:0:1::/64".
std::string network_of(const std::string& address);

/// Truncates untrusted input to 80 bytes for a message and replaces all but printable ASCII by '?'.
std::string shown(std::string_view text);

class OriginPolicy {
  public:
    OriginPolicy(std::vector<std::string> hosts, std::vector<std::string> origins);
    /// Returns the reason for a rejection, or empty. A request without an Origin header does not come from a browser
    /// page.
    std::string problem(const RequestHead& head) const;

  private:
    bool knows(const std::string& name, const Peer& peer) const;
    std::vector<std::string> hosts_, origins_;
};

}  // namespace motionrack::server
