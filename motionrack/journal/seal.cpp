#include <openssl/evp.h>

#include <array>
#include <motionrack/journal/seal.hpp>

namespace motionrack::journal {

Seal& Seal::add(std::string_view text) {
    fields_ += std::to_string(text.size());
    fields_ += ':';
    fields_ += text;
    fields_ += ',';
    return *this;
}

namespace {

/// Looks the algorithm up once, because a lookup takes longer than the hash of an entry.
const EVP_MD* sha256() {
    static const EVP_MD* const found = EVP_MD_fetch(nullptr, "SHA256", nullptr);
    MOTIONRACK_ASSERT(found != nullptr);
    return found;
}

}  // namespace

std::string Seal::text() const {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
    unsigned int count = 0;
    MOTIONRACK_ASSERT(EVP_Digest(fields_.data(), fields_.size(), bytes.data(), &count, sha256(), nullptr) == 1);
    std::string out;
    for (unsigned int i = 0; i < count; ++i) {
        out += "0123456789abcdef"[bytes[i] >> 4];
        out += "0123456789abcdef"[bytes[i] & 15];
    }
    return out;
}

std::string seal_of_kept(std::string_view key, std::string_view value, std::int64_t run, std::int64_t utc_ms) {
    return Seal().add("kept").add(key).add(value).add(run).add(utc_ms).text();
}

std::string seal_of_run(std::int64_t run, std::int64_t begun_ms, std::int64_t ended_ms,
                        const std::map<std::string, std::string>& seals, std::string_view link) {
    Seal out;
    out.add("run").add(run).add(begun_ms).add(ended_ms).add(link);
    for (const auto& [key, seal] : seals) out.add(key).add(seal);
    return out.text();
}

std::string link_of(std::string_view before, const Entry& entry) {
    return Seal()
        .add(before)
        .add(entry.number)
        .add(entry.run)
        .add(entry.utc_ms)
        .add(entry.at.count())
        .add(entry.kind)
        .add(entry.text)
        .add(entry.data)
        .text();
}

}  // namespace motionrack::journal
