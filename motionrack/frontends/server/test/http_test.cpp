// HTTP requests: the page, pairing, queries, commands, STOP, and permissions.
#include <gmock/gmock.h>

#include <atomic>
#include <motionrack/frontends/server/site_server.hpp>

#include "running.hpp"

namespace motionrack::server {
namespace {

using auth::Role;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string bearer(const std::string& token) {
    return "Authorization: Bearer " + token + "\r\n";
}

class PageServer : public testing::Test {
  protected:
    Running running;
    WebClient client = running.client();
};

TEST_F(PageServer, ServesAPageThatLoadsNothingFromOtherHosts) {
    const WebAnswer page = client.ask("GET", "/");
    EXPECT_EQ(page.status, 200);
    EXPECT_THAT(page.body, HasSubstr("its page has not been built"));
    const auto fields = page.fields;
    EXPECT_EQ(fields.at("content-type"), "text/html; charset=utf-8");
    EXPECT_EQ(fields.at("content-security-policy"),
              "default-src 'self'; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    EXPECT_EQ(fields.at("x-content-type-options"), "nosniff");
    EXPECT_EQ(fields.at("referrer-policy"), "no-referrer");
    const WebAnswer head = client.ask("HEAD", "/missing");
    EXPECT_EQ(head.status, 404);
}

TEST_F(PageServer, AnswersRequestsAfterAHeadRequestInOrder) {
    EXPECT_EQ(client.ask("HEAD", "/").status, 200);
    EXPECT_THAT(client.ask("GET", "/").body, HasSubstr("its page has not been built"));
    client.send("HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\nGET /api/status HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(client.answer(true).status, 200);
    EXPECT_TRUE(client.answer().json()["done"]);
    EXPECT_EQ(client.ask("HEAD", "/").status, 200);
    client.send("GET / HTTP/1.1\r\nHost localhost\r\n\r\n");
    const WebAnswer broken = client.answer();
    EXPECT_EQ(broken.status, 400);
    EXPECT_THAT(broken.message(), HasSubstr("not an HTTP/1.1 request")) << "the body is that of the broken request";
    EXPECT_EQ(client.receive().kind, -1) << "nothing comes behind it";
}

TEST_F(PageServer, AnswersAnInvalidHeadRequestWithoutABody) {
    for (const std::string& request :
         {std::string("HEAD / HTTP/1.1\r\nHost localhost\r\n\r\n"),
          "HEAD / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(9000, 'x') + "\r\n\r\n"}) {
        WebClient other = running.client();
        other.send(request);
        const WebAnswer head = other.answer(true);
        EXPECT_EQ(head.status, request.size() > 9000 ? 431 : 400);
        EXPECT_NE(head.fields.at("content-length"), "0");
        EXPECT_EQ(other.receive().kind, -1) << "nothing comes behind its head";
    }
}

TEST_F(PageServer, AnswersQueriesOfThisComputerWithoutAToken) {
    const WebAnswer status = client.ask("GET", "/api/status");
    ASSERT_EQ(status.status, 200) << status.body;
    EXPECT_TRUE(status.json()["done"]);
    EXPECT_EQ(status.fields.at("cache-control"), "no-store");
    EXPECT_EQ(client.ask("GET", "/api/openapi.json").json()["openapi"].get<std::string>().substr(0, 2), "3.");
}

TEST_F(PageServer, RejectsCommandsWithoutAToken) {
    for (const char* command : {"enable", "take_control", "invite", "home"}) {
        const WebAnswer answer = client.ask("POST", std::string("/api/") + command, "{}");
        EXPECT_EQ(answer.status, 403) << command;
        EXPECT_THAT(answer.message(), HasSubstr("needs the role")) << command;
    }
    EXPECT_TRUE(running.audited("enable", 403));
}

TEST_F(PageServer, PairsByACodeAndAcceptsCommandsWithItsToken) {
    const std::string code = running.served->door().start_code();
    const WebAnswer paired = client.ask("POST", "/api/pair", nlohmann::json{{"code", code}, {"name", "anna"}}.dump());
    ASSERT_EQ(paired.status, 200) << paired.body;
    EXPECT_EQ(paired.json()["role"], "maintain");
    EXPECT_EQ(paired.json()["user"], "anna");
    const std::string token = paired.json()["token"];
    EXPECT_EQ(client.ask("POST", "/api/take_control", "", bearer(token)).status, 200);
    EXPECT_EQ(client.ask("POST", "/api/enable", "{\"on\":true}", bearer(token)).status, 200);
    EXPECT_TRUE(running.audited("enable", 200));
    const WebAnswer again = client.ask("POST", "/api/pair", nlohmann::json{{"code", code}, {"name", "bert"}}.dump());
    EXPECT_EQ(again.status, 403) << "a code is good once";
    EXPECT_TRUE(running.audited("pair", 403));
}

TEST_F(PageServer, LimitsTheRateOfPairingAttempts) {
    WebAnswer answer;
    for (int i = 0; i < 6; ++i) answer = client.ask("POST", "/api/pair", "{\"code\":\"AAAA-AAAA\",\"name\":\"eve\"}");
    EXPECT_EQ(answer.status, 429);
    EXPECT_EQ(answer.fields.at("retry-after"), "1");
    EXPECT_EQ(client.ask("POST", "/api/pair", "{\"name\":\"eve\"}").status, 400);
}

TEST_F(PageServer, RejectsForgedExpiredAndRevokedTokens) {
    EXPECT_EQ(client.ask("GET", "/api/status", "", bearer(std::string(64, '0'))).status, 401);
    EXPECT_EQ(client.ask("GET", "/api/status", "", "Authorization: Basic YTpi\r\n").status, 401);
    const std::string anna = running.token("anna"), bert = running.token("bert", Role::observe);
    EXPECT_EQ(client.ask("GET", "/api/users", "", bearer(bert)).status, 403);
    EXPECT_EQ(client.ask("POST", "/api/revoke_user", "{\"user\":\"bert\"}", bearer(anna)).status, 200);
    const WebAnswer revoked = client.ask("GET", "/api/status", "", bearer(bert));
    EXPECT_EQ(revoked.status, 401);
    EXPECT_THAT(revoked.message(), HasSubstr("revoked"));
    EXPECT_EQ(revoked.fields.at("www-authenticate"), "Bearer");
    EXPECT_EQ(client.ask("GET", "/api/users", "", bearer(anna)).status, 200);
    running.let_pass(std::chrono::hours(24 * 91));
    EXPECT_THAT(client.ask("GET", "/api/status", "", bearer(anna)).message(), HasSubstr("expired"));
    EXPECT_TRUE(running.audited("token", 401));
}

TEST_F(PageServer, InvitesWithTheRequestedRole) {
    const std::string anna = running.token("anna");
    const WebAnswer invited = client.ask("POST", "/api/invite", "{\"role\":\"operate\"}", bearer(anna));
    ASSERT_EQ(invited.status, 200) << invited.body;
    const WebAnswer paired =
        client.ask("POST", "/api/pair", nlohmann::json{{"code", invited.json()["code"]}, {"name", "bert"}}.dump());
    EXPECT_EQ(paired.json()["role"], "operate");
    EXPECT_EQ(client.ask("POST", "/api/invite", "{\"role\":\"operate\"}", bearer(paired.json()["token"])).status, 403);
}

TEST_F(PageServer, StopsForEveryClient) {
    EXPECT_EQ(client.ask("POST", "/api/stop").status, 200);
    EXPECT_EQ(client.ask("POST", "/api/stop", "no JSON at all", bearer("nonsense")).status, 200);
    EXPECT_TRUE(running.audited("stop", 200));
    WebClient other = running.client();
    EXPECT_EQ(other.ask("GET", "/api/stop").status, 405);
}

TEST_F(PageServer, ReportsTheErrorOfAnInvalidRequest) {
    const std::string anna = bearer(running.token("anna"));
    EXPECT_EQ(client.ask("GET", "/api/nothing").status, 404);
    const WebAnswer former = client.ask("POST", "/api/begin", "", anna);
    EXPECT_EQ(former.status, 404);
    EXPECT_EQ(former.message(), "'begin' is now 'start_program'. Nothing was done.");
    EXPECT_EQ(client.ask("POST", "/api/status").status, 405);
    EXPECT_EQ(client.ask("GET", "/api/enable", "", anna).status, 405);
    EXPECT_EQ(client.ask("GET", "/api/stream").status, 426);
    EXPECT_EQ(client.ask("GET", "/api/status?a=%zz").status, 400);
    EXPECT_EQ(client.ask("GET", "/api/status?more=1").status, 400);
    const WebAnswer wrong = client.ask("POST", "/api/enable", "{\"on\":\n tru}", anna);
    EXPECT_EQ(wrong.status, 400);
    EXPECT_EQ(wrong.json()["error"]["line"], 2);
    EXPECT_EQ(client.ask("POST", "/api/enable", "[1]", anna).status, 400);
    EXPECT_EQ(client.ask("POST", "/api/enable", "{\"on\":1e999}", anna).status, 400);
    EXPECT_THAT(client.ask("POST", "/api/enable", std::string(40'000, '['), anna).message(),
                HasSubstr("nested deeper"));
}

TEST_F(PageServer, AcceptsRequestsOfItsOwnPagesOnly) {
    const auto with = [&](const std::string& host, const std::string& origin) {
        client.host = host;
        return client.ask("GET", "/api/status", "", origin.empty() ? "" : "Origin: " + origin + "\r\n").status;
    };
    const std::string own = client.host, port = own.substr(own.find(':'));
    EXPECT_EQ(with(own, "http://" + own), 200);
    EXPECT_EQ(with("localhost" + port, "http://localhost" + port), 200);
    EXPECT_EQ(with("LocalHost" + port, ""), 200);
    EXPECT_EQ(with("rack.example" + port, ""), 403) << "a name that leads here is not enough";
    EXPECT_EQ(with("127.0.0.2" + port, ""), 403);
    EXPECT_EQ(with("", ""), 403);
    EXPECT_EQ(with(own, "http://rack.example"), 403);
    EXPECT_EQ(with(own, "http://localhost" + port), 403) << "another origin, though the same computer";
    EXPECT_EQ(with(own, "https://" + own), 403);
    EXPECT_EQ(with(own, "null"), 403);
    client.host = own;
    EXPECT_EQ(client.ask("POST", "/api/stop", "", "Origin: http://rack.example\r\n").status, 403)
        << "it holds for STOP, too";
    EXPECT_EQ(client.ask("POST", "/api/stop", "", "Origin: http://" + own + "\r\n").status, 200);
    WebClient stranger = running.client();
    EXPECT_EQ(stranger.upgrade("Origin: http://rack.example\r\n").status, 403);
}

TEST(ServersGuard, AcceptsConfiguredNamesAndOrigins) {
    Running running([](ServerSettings& settings) {
        settings.hosts = {"Rack.Example"};
        settings.origins = {"http://localhost:5173"};
    });
    WebClient client = running.client();
    EXPECT_EQ(client.ask("GET", "/api/status", "", "Origin: http://localhost:5173\r\n").status, 200);
    client.host = "rack.example:1234";
    EXPECT_EQ(client.ask("GET", "/api/status").status, 200);
    EXPECT_EQ(client.ask("GET", "/api/status", "", "Origin: http://rack.example:1234\r\n").status, 200);
}

class PageFolder : public testing::Test {
  protected:
    PageFolder() : folder(fs::temp_directory_path() / ("page-" + std::to_string(::getpid()))) {
        fs::create_directories(folder / "page/assets");
        write("page/index.html", "<!doctype html>");
        write("page/assets/a.js", "1");
        write("secret.txt", "secret");
        fs::create_symlink(folder / "secret.txt", folder / "page/assets/link.txt");
    }
    ~PageFolder() override { fs::remove_all(folder); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
    fs::path folder;
};

TEST_F(PageFolder, IsServedFromMemoryByWholeNames) {
    Running running({}, *Page::read(folder / "page"));
    WebClient client = running.client();
    EXPECT_EQ(client.ask("GET", "/").body, "<!doctype html>");
    const WebAnswer script = client.ask("GET", "/assets/a.js");
    EXPECT_EQ(script.body, "1");
    EXPECT_EQ(script.fields.at("content-type"), "text/javascript; charset=utf-8");
    EXPECT_THAT(script.fields.at("cache-control"), HasSubstr("immutable"));
    const WebAnswer head = client.ask("HEAD", "/api/status");
    EXPECT_EQ(head.status, 405);
    WebClient other = running.client();
    for (const char* path :
         {"/../secret.txt", "/assets/../../secret.txt", "/%2e%2e/secret.txt", "/assets/..%2f..%2fsecret.txt",
          "//etc/passwd", "/assets/link.txt", "/assets/", "/index.html/", "/assets\\a.js", "/secret.txt"})
        EXPECT_EQ(other.ask("GET", path).status, 404) << path;
}

TEST_F(PageFolder, IsServedBelowAFolderOfAnotherPage) {
    Page page;
    page.mount("/docs", *Page::read(folder / "page"));
    Running running({}, page);
    WebClient client = running.client();
    EXPECT_THAT(client.ask("GET", "/").body, HasSubstr("its page has not been built"));
    EXPECT_EQ(client.ask("GET", "/docs/").body, "<!doctype html>");
    EXPECT_EQ(client.ask("GET", "/docs/index.html").body, "<!doctype html>");
    EXPECT_EQ(client.ask("GET", "/docs/assets/a.js").body, "1");
    EXPECT_THAT(client.ask("GET", "/docs/").fields.at("content-security-policy"), HasSubstr("default-src 'self'"));
    for (const char* path : {"/docs", "/assets/a.js", "/docs/../secret.txt", "/docs/assets/link.txt", "/docs/assets"})
        EXPECT_EQ(client.ask("GET", path).status, 404) << path;
}

TEST_F(PageFolder, IsServedWithoutARackToThisComputerAlone) {
    auto site = *SiteServer::open(*Page::read(folder / "page"), 0);
    std::atomic<bool> done{false};
    std::thread thread([&] {
        while (!done) site->serve_for(std::chrono::milliseconds(1));
    });
    const std::string url = site->url();
    WebClient client(static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1))));
    EXPECT_EQ(client.ask("GET", "/").body, "<!doctype html>");
    EXPECT_EQ(client.ask("GET", "/index.html?q=1").body, "<!doctype html>");
    EXPECT_EQ(client.ask("GET", "/assets/a.js").body, "1");
    EXPECT_THAT(client.ask("GET", "/").fields.at("content-security-policy"), HasSubstr("default-src 'self'"));
    EXPECT_EQ(client.ask("GET", "/../secret.txt").status, 404);
    EXPECT_EQ(client.ask("DELETE", "/").status, 405);
    client.host = "elsewhere.example";
    EXPECT_EQ(client.ask("GET", "/").status, 403);
    done = true;
    thread.join();
}

TEST_F(PageFolder, WithoutAnIndexIsRejected) {
    EXPECT_THAT(Page::read(folder / "page/assets").error().message, HasSubstr("no index.html"));
    EXPECT_FALSE(Page::read(folder / "nowhere"));
}

TEST(ServersAddress, IsLoopbackUnlessThereIsTls) {
    try {
        Running running([](ServerSettings& settings) { settings.address = "0.0.0.0"; });
        FAIL() << "it was served";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("requires TLS"));
    }
    try {
        Running running([](ServerSettings& settings) { settings.address = "localhorst"; });
        FAIL() << "it was served";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("is not an IPv4 or IPv6 address"));
    }
}

TEST(ServersPort, InUseIsReportedWithTheRemedy) {
    Running running;
    try {
        Running second([&](ServerSettings& settings) { settings.port = running.port(); });
        FAIL() << "it was served";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("used by another program"));
    }
}

}  // namespace
}  // namespace motionrack::server
