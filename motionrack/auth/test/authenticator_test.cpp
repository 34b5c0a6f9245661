// Codes, tokens and the users file, at times set by the test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <motionrack/auth/authenticator.hpp>
#include <motionrack/auth/private_files.hpp>
#include <motionrack/auth/secrets.hpp>

namespace motionrack::auth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
namespace fs = std::filesystem;

class AuthenticatorTest : public testing::Test {
  protected:
    AuthenticatorTest() : folder(fs::temp_directory_path() / ("authenticator-" + std::to_string(::getpid()))) {
        fs::create_directories(folder);
        open();
    }
    ~AuthenticatorTest() override { fs::remove_all(folder); }
    void open(AuthSettings settings = {}) {
        auto made = try_open(std::move(settings));
        ASSERT_TRUE(made) << made.error().text();
        door = std::move(*made);
    }
    Result<std::unique_ptr<Authenticator>> try_open(AuthSettings settings = {}) {
        settings.users_file = file();
        settings.on_start_code = [this](const std::string& code) { start_codes.push_back(code); };
        return Authenticator::open(settings);
    }
    fs::path file() const { return folder / "users.json"; }
    std::string text() const {
        std::ifstream in(file());
        return std::string((std::istreambuf_iterator<char>(in)), {});
    }
    void write(const std::string& text) const {
        std::ofstream(file()) << text;
        ::chmod(file().c_str(), 0600);
    }
    void pass(std::chrono::seconds time) { now = {now.wall + time, now.steady + time}; }
    auto pair(const std::string& code, const std::string& name, const std::string& address = "127.0.0.1") {
        return door->pair(code, name, address, now);
    }

    fs::path folder;
    Timestamps now{WallTime(std::chrono::hours(500'000)), {}};
    std::vector<std::string> start_codes;
    std::unique_ptr<Authenticator> door;
};

TEST_F(AuthenticatorTest, PairsTheFirstUserWithTheStartCodeAndReplacesTheCode) {
    ASSERT_EQ(start_codes.size(), 1u);
    const auto anna = pair(start_codes[0], "anna");
    ASSERT_TRUE(anna) << anna.error().sentence;
    EXPECT_EQ(anna->identity.role, Role::maintain);
    EXPECT_EQ(anna->token.size(), 64u);
    ASSERT_EQ(start_codes.size(), 2u);
    EXPECT_NE(start_codes[0], start_codes[1]);
    EXPECT_EQ(door->start_code(), start_codes[1]);
    EXPECT_THAT(pair(start_codes[0], "bert").error().sentence, HasSubstr("used already"));
    const auto who = door->authenticate(anna->token, now.wall);
    ASSERT_TRUE(who);
    EXPECT_EQ(who->user, "anna");
    EXPECT_EQ(who->id, anna->identity.id);
}

TEST_F(AuthenticatorTest, AcceptsCodesInLowerCaseAndWithoutHyphens) {
    EXPECT_EQ(plain_code(" abcd-0il o "), "ABCD0110");
    std::string typed;
    for (const char c : start_codes[0])
        if (c != '-') typed += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    EXPECT_TRUE(pair(typed, "anna"));
}

TEST_F(AuthenticatorTest, AcceptsAnInvitationOnceWithinTenMinutesAndGrantsItsRole) {
    const std::string code = *door->invite(Role::observe, now);
    const auto bert = pair(code, "bert");
    ASSERT_TRUE(bert);
    EXPECT_EQ(bert->identity.role, Role::observe);
    EXPECT_FALSE(pair(code, "carl")) << "one use a code";
    const std::string late = *door->invite(Role::operate, now);
    pass(10min);
    EXPECT_THAT(pair(late, "carl").error().sentence, HasSubstr("has expired"));
    EXPECT_TRUE(pair(start_codes.back(), "carl")) << "the start code waits";
    EXPECT_FALSE(door->invite(Role::none, now));
}

TEST_F(AuthenticatorTest, PairsATakenNameWithTheStartCodeOnly) {
    ASSERT_TRUE(pair(start_codes[0], "anna"));
    const std::string code = *door->invite(Role::observe, now);
    EXPECT_THAT(pair(code, "anna").error().sentence, HasSubstr("anna is paired already"));
    EXPECT_TRUE(pair(code, "anne")) << "the code is still good";
    EXPECT_TRUE(pair(start_codes[1], "anna"));
    EXPECT_EQ(door->users().size(), 3u);
}

TEST_F(AuthenticatorTest, LimitsTheRateOfWrongCodesPerAddressAndInTotal) {
    for (int i = 0; i < 5; ++i) EXPECT_EQ(pair("AAAA-AAAA", "eve", "10.0.0.1").error().reason, AuthError::Why::wrong);
    EXPECT_EQ(pair(start_codes[0], "eve", "10.0.0.1").error().reason, AuthError::Why::too_many)
        << "even a right one is not looked at";
    for (int i = 0; i < 55; ++i)
        EXPECT_EQ(pair("AAAA-AAAA", "eve", "10.0.1." + std::to_string(i)).error().reason, AuthError::Why::wrong);
    EXPECT_EQ(pair("AAAA-AAAA", "eve", "10.0.2.1").error().reason, AuthError::Why::too_many);
    pass(2s);
    EXPECT_EQ(pair("AAAA-AAAA", "eve", "10.0.0.1").error().reason, AuthError::Why::too_many);
    EXPECT_TRUE(pair(start_codes[0], "anna", "10.0.2.1"));
}

TEST_F(AuthenticatorTest, RejectsExpiredRevokedAndForgedTokens) {
    const auto anna = *pair(start_codes[0], "anna");
    EXPECT_FALSE(door->authenticate("", now.wall));
    EXPECT_FALSE(door->authenticate(std::string(64, 'a'), now.wall));
    EXPECT_FALSE(door->authenticate(hash_of(anna.token), now.wall)) << "what stands in the file lets nobody in";
    EXPECT_EQ(door->role_of(anna.identity.id, now.wall), Role::maintain);
    pass(90 * 24h - 1s);
    EXPECT_TRUE(door->authenticate(anna.token, now.wall));
    pass(1s);
    EXPECT_THAT(door->authenticate(anna.token, now.wall).error().sentence, HasSubstr("expired"));
    EXPECT_EQ(door->role_of(anna.identity.id, now.wall), Role::none);
    const auto bert = *pair(start_codes[1], "bert");
    EXPECT_TRUE(door->revoke("bert"));
    EXPECT_THAT(door->authenticate(bert.token, now.wall).error().sentence, HasSubstr("revoked"));
    EXPECT_EQ(door->role_of(bert.identity.id, now.wall), Role::none);
    EXPECT_FALSE(door->revoke("bert"));
}

TEST_F(AuthenticatorTest, StoresHashesInAFileThatOnlyItsOwnerMayRead) {
    const auto anna = *pair(start_codes[0], "anna");
    struct stat about;
    ASSERT_EQ(::stat(file().c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777, 0600u);
    EXPECT_THAT(text(), HasSubstr(hash_of(anna.token)));
    EXPECT_THAT(text(), testing::Not(HasSubstr(anna.token)));
    open();
    const auto who = door->authenticate(anna.token, now.wall);
    ASSERT_TRUE(who);
    EXPECT_EQ(who->role, Role::maintain);
    EXPECT_EQ(who->expires, anna.identity.expires);
    EXPECT_TRUE(door->revoke("anna"));
    open();
    EXPECT_FALSE(door->authenticate(anna.token, now.wall));
}

TEST_F(AuthenticatorTest, RefusesAFileThatIsDamagedOrThatOthersMayWrite) {
    const std::string hash(64, 'a');
    const auto user = [&](const std::string& fields) { return "{\"users\":[{" + fields + "}]}"; };
    const std::string token = "\"token_sha256\":\"" + hash + "\"", expires = "\"expires\":1",
                      role = "\"role\":\"observe\"", name = "\"name\":\"a\"";
    write(user(name + "," + role + "," + token + "," + expires));
    EXPECT_TRUE(try_open());
    for (const std::string& wrong : std::vector<std::string>{
             "{", "[]", "{}", "{\"users\":1}", "{\"users\":[1]}", user(""),
             user(name + ",\"role\":\"none\"," + token + "," + expires),
             user(name + ",\"role\":\"owner\"," + token + "," + expires),
             user(name + "," + role + ",\"token_sha256\":\"" + std::string(64, 'A') + "\"," + expires),
             user(name + "," + role + "," + token + ",\"expires\":1.5"),
             user("\"name\":1," + role + "," + token + "," + expires),
             user(name + "," + role + ",\"token_sha256\":\"aa\"," + expires), user(name + "," + role + "," + token),
             user(name + "," + role + "," + token + ",\"expires\":-1"),
             user(name + "," + role + "," + token + "," + expires + "},{\"name\":\"b\",\"role\":\"maintain\"," + token +
                  "," + expires)}) {
        write(wrong);
        const auto opened = try_open();
        ASSERT_FALSE(opened) << wrong;
        EXPECT_THAT(opened.error().message, HasSubstr("damaged"));
    }
    write(R"({"users":[]})");
    EXPECT_TRUE(try_open());
    ::chmod(file().c_str(), 0620);
    EXPECT_THAT(try_open().error().message, HasSubstr("Others may write the users file (mode 620)"));
    ::chmod(file().c_str(), 0600);
    EXPECT_TRUE(try_open());
    ::chmod(folder.c_str(), 0777);
    EXPECT_THAT(try_open().error().message, HasSubstr("Others may replace the users file: its folder"));
    ::chmod(folder.c_str(), 01777);
    EXPECT_TRUE(try_open()) << "sticky, as /tmp";
}

TEST_F(AuthenticatorTest, RefusesAFolderInPlaceOfItsFile) {
    fs::create_directory(file());
    const auto opened = try_open();
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().message, "The users path is not a regular file.");
    EXPECT_EQ(opened.error().file, file().string());
}

TEST_F(AuthenticatorTest, WithoutAFileKeepsItsUsersInMemory) {
    const auto memory = *Authenticator::open({});
    const auto bert = memory->pair(*memory->invite(Role::operate, now), "bert", "127.0.0.1", now);
    ASSERT_TRUE(bert) << bert.error().sentence;
    EXPECT_TRUE(memory->authenticate(bert->token, now.wall));
    EXPECT_TRUE((*Authenticator::open({}))->users().empty());
    EXPECT_FALSE(fs::exists(file()));
}

TEST_F(AuthenticatorTest, ChecksTheFolderBeforeTheFirstUserIsWritten) {
    fs::remove(file());
    ::chmod(folder.c_str(), 0777);
    EXPECT_THAT(try_open().error().message, HasSubstr("(mode 777)"));
}

TEST_F(AuthenticatorTest, RejectsAKeyFileThatOthersMayRead) {
    write("key");
    EXPECT_TRUE(check_readers(file().string(), "The key"));
    ::chmod(file().c_str(), 0644);
    EXPECT_THAT(check_readers(file().string(), "The key").error().message, HasSubstr("Others may read the key"));
    if (::geteuid() != 0) return;
    ::chmod(file().c_str(), 0640);
    EXPECT_TRUE(check_readers(file().string(), "The key")) << "root's, for a group";
    ASSERT_EQ(::chown(file().c_str(), 12345, static_cast<gid_t>(-1)), 0);
    EXPECT_FALSE(check_readers(file().string(), "The key"));
}

TEST_F(AuthenticatorTest, RejectsAUsersFileBelowARegularFile) {
    write("{}");
    AuthSettings settings;
    settings.users_file = file() / "users.json";  // inside a file, as if it were a folder
    const auto opened = Authenticator::open(settings);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().kind, ErrorKind::io);
    EXPECT_THAT(opened.error().message, HasSubstr("Not a directory"));
    EXPECT_EQ(opened.error().file, settings.users_file.string());
}

TEST_F(AuthenticatorTest, PairsNoUserIfTheFileCannotBeWritten) {
    fs::remove_all(folder);
    const auto anna = pair(start_codes[0], "anna");
    ASSERT_FALSE(anna);
    EXPECT_EQ(anna.error().reason, AuthError::Why::failed);
    EXPECT_TRUE(door->users().empty());
    fs::create_directories(folder);
    EXPECT_TRUE(pair(start_codes[0], "anna")) << "the code was not used up";
}

TEST_F(AuthenticatorTest, KeepsAnInvitationThatPairedNoUser) {
    const std::string code = *door->invite(Role::observe, now);
    fs::remove_all(folder);
    ASSERT_FALSE(pair(code, "bert"));
    fs::create_directories(folder);
    const auto bert = pair(code, "bert");
    ASSERT_TRUE(bert) << bert.error().sentence;
    EXPECT_EQ(bert->identity.role, Role::observe);
}

TEST_F(AuthenticatorTest, RevokesNoUserIfTheFileCannotBeWritten) {
    const auto anna = *pair(start_codes[0], "anna");
    fs::remove_all(folder);
    EXPECT_EQ(door->revoke("anna").error().kind, ErrorKind::io);
    EXPECT_EQ(door->forget(anna.identity.id).error().kind, ErrorKind::io);
    EXPECT_TRUE(door->authenticate(anna.token, now.wall)) << "as the file has it";
}

TEST_F(AuthenticatorTest, RevokesOneTokenOfAUser) {
    const auto first = *pair(start_codes[0], "anna"), second = *pair(start_codes[1], "anna");
    EXPECT_FALSE(door->forget("0123"));
    EXPECT_TRUE(door->forget(first.identity.id));
    EXPECT_FALSE(door->authenticate(first.token, now.wall));
    EXPECT_TRUE(door->authenticate(second.token, now.wall));
    open();
    EXPECT_FALSE(door->authenticate(first.token, now.wall));
    EXPECT_TRUE(door->authenticate(second.token, now.wall));
}

TEST_F(AuthenticatorTest, LimitsPairedDevicesAndRemovesThoseWithExpiredTokens) {
    AuthSettings two;
    two.max_tokens = 2;
    open(two);
    ASSERT_TRUE(pair(start_codes.back(), "anna"));
    pass(1h);
    ASSERT_TRUE(pair(start_codes.back(), "bert"));
    EXPECT_THAT(pair(start_codes.back(), "carl").error().sentence, HasSubstr("limit of 2 paired devices"));
    pass(90 * 24h - 1h);
    EXPECT_TRUE(pair(start_codes.back(), "carl")) << "anna's has expired";
    ASSERT_EQ(door->users().size(), 2u);
    EXPECT_EQ(door->users()[0].user, "bert");
    AuthSettings one;
    one.max_tokens = 1;
    open(one);
    pass(1h);
    EXPECT_FALSE(pair(start_codes.back(), "dora")) << "bert's has expired, carl's is there";
    EXPECT_EQ(door->users().size(), 2u) << "a refusal changes nothing";
}

TEST_F(AuthenticatorTest, LimitsOpenCodesAndRemovesExpiredOnes) {
    AuthSettings two;
    two.max_invitations = 2;
    open(two);
    ASSERT_TRUE(door->invite(Role::observe, now));
    pass(1min);
    ASSERT_TRUE(door->invite(Role::observe, now));
    EXPECT_THAT(door->invite(Role::observe, now).error().message, HasSubstr("limit of 2 open invitations"));
    pass(9min);
    EXPECT_TRUE(door->invite(Role::observe, now)) << "the first is over";
    EXPECT_FALSE(door->invite(Role::observe, now)) << "the second is not";
}

TEST_F(AuthenticatorTest, AcceptsAFolderThatTheUsersOwnGroupMayWriteAndNoOtherGroup) {
    ::chmod(folder.c_str(), 0770);
    EXPECT_TRUE(try_open());
    if (::geteuid() != 0) return;
    ASSERT_EQ(::chown(folder.c_str(), static_cast<uid_t>(-1), 12345), 0);
    EXPECT_FALSE(try_open());
}

TEST_F(AuthenticatorTest, ReadsExpiryTimesUpToTheYear2255) {
    const std::string begin =
        R"({"users":[{"name":"a","role":"observe","token_sha256":")" + std::string(64, 'a') + R"(","expires":)";
    for (const char* good : {"0", "9000000000"}) {
        write(begin + good + "}]}");
        EXPECT_TRUE(try_open()) << good;
    }
    write(begin + "9000000001}]}");
    EXPECT_FALSE(try_open());
}

TEST_F(AuthenticatorTest, RejectsNamesWithControlOrMarkupCharactersAndOverlongNames) {
    for (const char* good :
         {"anna", "Anna B. 2", "j\xc3\xb6rg", "a", "09AZaz._-\x80", "1234567890123456789012345678901234567890"})
        EXPECT_EQ(name_problem(good), "") << good;
    for (const char bad : std::string_view("/:@[`{\x7f\x1f!")) EXPECT_NE(name_problem({&bad, 1}), "") << bad;
    for (const char* bad : {"", " a", "a ", "a\nb", "a\"b", "<b>", "12345678901234567890123456789012345678901"})
        EXPECT_NE(name_problem(bad), "") << bad;
    EXPECT_FALSE(pair(start_codes[0], "a\nb"));
    EXPECT_TRUE(pair(start_codes[0], "anna"));
}

TEST_F(AuthenticatorTest, WithoutAStartCodeAcceptsExistingUsersOnly) {
    const auto anna = *pair(start_codes[0], "anna");
    AuthSettings settings;
    settings.users_file = file();
    const auto closed = *Authenticator::open(settings);
    EXPECT_EQ(closed->start_code(), "");
    EXPECT_FALSE(closed->pair("", "eve", "127.0.0.1", now));
    EXPECT_TRUE(closed->authenticate(anna.token, now.wall));
}

TEST(Secrets, DifferEachTime) {
    EXPECT_NE(random_token(), random_token());
    EXPECT_NE(random_code(), random_code());
    EXPECT_EQ(random_code().size(), 9u);
    EXPECT_EQ(random_code().find('-'), 4u);
    EXPECT_EQ(plain_code(random_code()).size(), 8u);
    EXPECT_EQ(hash_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_TRUE(same_secret("abc", "abc"));
    EXPECT_FALSE(same_secret("abc", "abd"));
    EXPECT_FALSE(same_secret("abc", "ab"));
}

}  // namespace
}  // namespace motionrack::auth
