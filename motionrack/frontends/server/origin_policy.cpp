// Checks the Host and Origin headers of requests; names are compared without regard to case.
#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <motionrack/frontends/server/origin_policy.hpp>

namespace motionrack::server {

namespace {

std::string lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

}  // namespace

std::string shown(std::string_view text) {
    std::string out;
    for (const char c : text.substr(0, 80)) out += c >= ' ' && c < 127 ? c : '?';
    return out;
}

std::string network_of(const std::string& address) {
    in6_addr six{};
    if (::inet_pton(AF_INET6, address.c_str(), &six) != 1) return address;
    for (int i = 8; i < 16; ++i) six.s6_addr[i] = 0;
    std::array<char, INET6_ADDRSTRLEN> text{};
    return fmt::format("{}/64", ::inet_ntop(AF_INET6, &six, text.data(), text.size()));
}

std::string host_name(std::string_view host) {
    if (!host.empty() && host.front() == '[') {
        const std::size_t end = host.find(']');
        return end == std::string_view::npos ? "" : lower(host.substr(1, end - 1));
    }
    std::string name = lower(host.substr(0, host.find(':')));
    if (!name.empty() && name.back() == '.') name.pop_back();
    return name;
}

OriginPolicy::OriginPolicy(std::vector<std::string> hosts, std::vector<std::string> origins)
    : hosts_(std::move(hosts)), origins_(std::move(origins)) {
    for (std::string& host : hosts_) host = host_name(host);
    for (std::string& origin : origins_) origin = lower(origin);
}

bool OriginPolicy::knows(const std::string& name, const Peer& peer) const {
    if (name.empty()) return false;
    if (name == peer.local || std::find(hosts_.begin(), hosts_.end(), name) != hosts_.end()) return true;
    return peer.loopback && (name == "localhost" || name == "127.0.0.1" || name == "::1");
}

std::string OriginPolicy::problem(const RequestHead& head) const {
    if (!knows(host_name(head.host), head.peer))
        return fmt::format(
            "This computer does not have the name \"{}\". Nothing was done; start the server with --allow-host NAME "
            "if it is correct.",
            shown(head.host));
    if (head.origin.empty()) return "";
    const std::string origin = lower(head.origin);
    if (origin == fmt::format("{}://{}", head.peer.secure ? "https" : "http", lower(head.host))) return "";
    if (std::find(origins_.begin(), origins_.end(), origin) != origins_.end()) return "";
    return fmt::format(
        "Pages from \"{}\" are not allowed. Nothing was done; start the server with --allow-origin ORIGIN if it is "
        "correct.",
        shown(head.origin));
}

}  // namespace motionrack::server
