// TLS: with a certificate that the test makes.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <sys/stat.h>

#include <motionrack/frontends/server/service.hpp>

#include "flood.hpp"
#include "running.hpp"

namespace motionrack::server {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A key and a certificate that it signed itself.
void make_certificate(const fs::path& certificate_file, const fs::path& key_file) {
    EVP_PKEY* key = ::EVP_EC_gen("P-256");
    X509* certificate = ::X509_new();
    ::ASN1_INTEGER_set(::X509_get_serialNumber(certificate), 1);
    ::X509_gmtime_adj(::X509_getm_notBefore(certificate), 0);
    ::X509_gmtime_adj(::X509_getm_notAfter(certificate), 3600);
    ::X509_set_pubkey(certificate, key);
    X509_NAME* name = ::X509_get_subject_name(certificate);
    ::X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>("localhost"), -1, -1,
                                 0);
    ::X509_set_issuer_name(certificate, name);
    ::X509_sign(certificate, key, ::EVP_sha256());
    FILE* file = std::fopen(certificate_file.c_str(), "w");
    ::PEM_write_X509(file, certificate);
    std::fclose(file);
    fs::remove(key_file);
    const mode_t before = ::umask(077);
    file = std::fopen(key_file.c_str(), "w");
    ::umask(before);
    ::PEM_write_PrivateKey(file, key, nullptr, nullptr, 0, nullptr, nullptr);
    std::fclose(file);
    ::X509_free(certificate);
    ::EVP_PKEY_free(key);
}

class ATlsServer : public testing::Test {
  protected:
    ATlsServer() : folder(fs::temp_directory_path() / ("tls-" + std::to_string(::getpid()))) {
        fs::create_directories(folder);
        make_certificate(folder / "cert.pem", folder / "key.pem");
        make_certificate(folder / "other.pem", folder / "other_key.pem");
    }
    ~ATlsServer() override { fs::remove_all(folder); }
    Running::Change tls(const std::string& certificate = "cert.pem", const std::string& key = "key.pem") const {
        return [this, certificate, key](ServerSettings& settings) {
            settings.tls = TlsFiles{(folder / certificate).string(), (folder / key).string()};
            settings.address = "0.0.0.0";
        };
    }
    fs::path folder;
};

TEST_F(ATlsServer, ServesOtherAddressesToWhoIsPaired) {
    Running running(tls());
    EXPECT_EQ(running.served->server().url().substr(0, 8), "https://");
    WebClient client(running.port(), true);
    ASSERT_TRUE(client.connected());
    EXPECT_EQ(client.ask("GET", "/").status, 200);
    EXPECT_EQ(client.ask("GET", "/api/status").status, 200);
    EXPECT_EQ(client.ask("GET", "/api/status", "", "Origin: https://" + client.host + "\r\n").status, 200);
    EXPECT_EQ(client.ask("GET", "/api/status", "", "Origin: http://" + client.host + "\r\n").status, 403);
    WebClient stream(running.port(), true);
    ASSERT_EQ(stream.upgrade().status, 101);
    EXPECT_TRUE(stream.order({{"token", running.token("anna")}}).value("done", false));
    EXPECT_TRUE(stream.order({{"order", "take_control"}}).value("done", false));
    EXPECT_TRUE(stream.receive_until([](const json& message) { return message.contains("seq"); }).is_object());
}

TEST_F(ATlsServer, SaysNothingToWhoSpeaksWithoutTls) {
    Running running(tls());
    WebClient client(running.port());
    EXPECT_EQ(client.ask("GET", "/").status, 0);
    WebClient good(running.port(), true);
    EXPECT_EQ(good.ask("POST", "/api/stop").status, 200);
}

TEST_F(ATlsServer, HearsStopInAFloodOfHandshakesThatEndNowhere) {
    Running running(tls());
    const std::string half_a_hello("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11);
    for (const std::string& says : {std::string(), half_a_hello, std::string("GET / HTTP/1.1\r\n\r\n")})
        for (const std::size_t held : {0u, 400u}) {
            const Flood flood(running.port(), held, Flood::Address::another, says);
            expect_stops_heard(flood, fmt::format("{} bytes said, {} connections held", says.size(), held),
                               [&] { return WebClient(running.port(), true).ask("POST", "/api/stop").status; });
        }
}

TEST_F(ATlsServer, IsNotStartedWithFilesThatDoNotBelongTogether) {
    const auto why = [&](const Running::Change& change) -> std::string {
        try {
            Running running(change);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(why(tls("cert.pem", "other_key.pem")), HasSubstr("is not that of the certificate"));
    EXPECT_THAT(why(tls("missing.pem", "key.pem")), HasSubstr("The certificate cannot be used"));
    EXPECT_THAT(why(tls("key.pem", "key.pem")), HasSubstr("The certificate cannot be used"));
}

TEST_F(ATlsServer, IsNotStartedWithAKeyThatOthersMayRead) {
    fs::permissions(folder / "key.pem", fs::perms::others_read, fs::perm_options::add);
    try {
        Running running(tls());
        FAIL() << "it was started";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(),
                    testing::AllOf(HasSubstr("key.pem"), HasSubstr("Others may read the key (mode 604)")));
    }
}

/// Who comes from another computer: its address is none of loopback.
TEST_F(ATlsServer, GivesNothingButThePageAndStopToStrangers) {
    Running running(tls());
    Service service({}, running.served->panel(), running.served->door(), running.served->lease(), Page(),
                    std::make_shared<Post>([](const std::function<void()>& work) { work(); }));
    RequestHead head;
    head.peer = {"192.0.2.7", "192.0.2.1", false, true, false};
    head.host = "192.0.2.1";
    const auto status = [&](const char* method, const char* target, const std::string& token = "") {
        head.method = method;
        head.target = target;
        head.authorization = token.empty() ? "" : "Bearer " + token;
        const Admission admission = service.admit(head);
        return admission.answer ? admission.answer->status : 0;
    };
    EXPECT_EQ(status("GET", "/"), 200);
    EXPECT_EQ(status("POST", "/api/stop"), 200);
    EXPECT_EQ(status("POST", "/api/pair"), 0) << "its body is waited for";
    EXPECT_EQ(status("GET", "/api/status"), 401);
    EXPECT_EQ(status("GET", "/api/openapi.json"), 401);
    EXPECT_EQ(status("POST", "/api/enable"), 401);
    EXPECT_EQ(status("GET", "/api/status", running.token("anna", auth::Role::observe)), 0);
    head.host = "localhost";
    EXPECT_EQ(status("GET", "/"), 403) << "that name is for this computer";
}

}  // namespace
}  // namespace motionrack::server
