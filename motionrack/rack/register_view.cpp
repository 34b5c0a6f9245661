// Decodes the bits of registers.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/rack/register_view.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::rack {

namespace {

std::uint32_t field_of(std::uint16_t word, const FieldInfo& field) {
    return (word & field.mask) / (field.mask & (~field.mask + 1u));
}

}  // namespace

std::string view_text(const RegisterView& view, bool all) {
    std::string out;
    for (const RegisterSnapshot& seen : view.registers) {
        out += fmt::format("{:<4} {:<2} {:0{}X}h  {}\n", seen.reg->name, seen.axis, seen.word, seen.reg->width / 4,
                           seen.reg->meaning);
        for (const FieldInfo& field : seen.reg->fields)
            if (const std::uint32_t value = field_of(seen.word, field); value != 0 || all)
                out += fmt::format("          {:<6} {:<5} {}\n", field.name, value, field.meaning);
    }
    for (const ValueSnapshot& seen : view.values)
        out += fmt::format("{:<4} {:<2} {:<11} {}\n", seen.name, seen.axis, seen.value, seen.meaning);
    return out;
}

std::string view_json(const RegisterView& view) {
    nlohmann::ordered_json out;
    out["registers"] = nlohmann::ordered_json::array();
    for (const RegisterSnapshot& seen : view.registers) {
        nlohmann::ordered_json one = {{"name", seen.reg->name}, {"axis", seen.axis}, {"word", seen.word}};
        for (const FieldInfo& field : seen.reg->fields)
            one["fields"][std::string(field.name)] = field_of(seen.word, field);
        out["registers"].push_back(std::move(one));
    }
    out["values"] = nlohmann::ordered_json::array();
    for (const ValueSnapshot& seen : view.values)
        out["values"].push_back({{"name", seen.name}, {"axis", seen.axis}, {"value", seen.value}});
    return out.dump(2) + "\n";
}

}  // namespace motionrack::rack
