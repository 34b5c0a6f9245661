// Server for the files of a Page on this computer alone, without a rack: `motionrack docs`.
//
//   serve_for ──► accept ──► head ──► the file, or a sentence ──► next head of the connection
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <motionrack/frontends/server/page.hpp>
#include <string>

namespace motionrack::server {

class SiteServer {
  public:
    /// Further connections are closed at once.
    static constexpr std::size_t max_connections = 100;

    /// Takes a port of 127.0.0.1; 0: any free one. Errors: io.
    static Result<std::unique_ptr<SiteServer>> open(Page site, std::uint16_t port);
    ~SiteServer();

    /// Returns the address of the site: "http://127.0.0.1:8081/".
    std::string url() const;
    /// Answers requests in the calling thread for this time.
    void serve_for(std::chrono::milliseconds time);

  private:
    class Inside;
    explicit SiteServer(std::unique_ptr<Inside> inside);
    std::unique_ptr<Inside> inside_;
};

}  // namespace motionrack::server
