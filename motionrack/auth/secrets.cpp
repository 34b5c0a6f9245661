// Random numbers and SHA-256 from OpenSSL.
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <motionrack/auth/secrets.hpp>
#include <motionrack/base/result.hpp>

namespace motionrack::auth {

namespace {

// Crockford's digits: without I, L, O and U.
constexpr std::string_view letters = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";

std::string hexadecimal(const unsigned char* bytes, std::size_t count) {
    std::string out;
    for (std::size_t i = 0; i < count; ++i) {
        out += "0123456789abcdef"[bytes[i] >> 4];
        out += "0123456789abcdef"[bytes[i] & 15];
    }
    return out;
}

}  // namespace

std::string random_token() {
    std::array<unsigned char, 32> bytes;
    MOTIONRACK_ASSERT(RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) == 1);
    return hexadecimal(bytes.data(), bytes.size());
}

std::string random_code() {
    std::array<unsigned char, 8> bytes;
    MOTIONRACK_ASSERT(RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) == 1);
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i == 4) out += '-';
        out += letters[bytes[i] % letters.size()];
    }
    return out;
}

std::string plain_code(std::string_view typed) {
    std::string out;
    for (const char c : typed) {
        const char capital = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        if (capital == '-' || capital == ' ') continue;
        out += capital == 'O' ? '0' : capital == 'I' || capital == 'L' ? '1' : capital;
    }
    return out;
}

std::string hash_of(std::string_view text) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
    unsigned int count = 0;
    MOTIONRACK_ASSERT(EVP_Digest(text.data(), text.size(), bytes.data(), &count, EVP_sha256(), nullptr) == 1);
    return hexadecimal(bytes.data(), count);
}

bool same_secret(std::string_view one, std::string_view other) {
    return one.size() == other.size() && CRYPTO_memcmp(one.data(), other.data(), one.size()) == 0;
}

}  // namespace motionrack::auth
