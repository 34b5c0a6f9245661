// Points of a sweep: values, rack, program.
#include <algorithm>
#include <motionrack/sweep/sweep.hpp>

namespace motionrack::sweep {

namespace {

using rack::TomlNode;

/// Mixes three numbers (the steps of SplitMix64), so that each value of each point is drawn independently.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t point, std::uint64_t parameter) {
    std::uint64_t out = seed;
    for (const std::uint64_t one : {point, parameter}) {
        out += 0x9E3779B97F4A7C15u * (one + 1);
        out = (out ^ (out >> 30)) * 0xBF58476D1CE4E5B9u;
        out = (out ^ (out >> 27)) * 0x94D049BB133111EBu;
        out ^= out >> 31;
    }
    return out;
}

TomlNode drawn(const VariedParameter& parameter, std::uint64_t luck) {
    const double part = static_cast<double>(luck >> 11) * 0x1p-53;
    if (!parameter.range)
        return parameter.values[static_cast<std::size_t>(part * static_cast<double>(parameter.values.size()))];
    const NumberRange& range = *parameter.range;
    TomlNode out;
    out.value_location = parameter.location;
    out.type = rack::TomlType::number;
    out.number = tidied(range.from + (range.to - range.from) * part, range);
    return out;
}

}  // namespace

std::vector<TomlNode> Sweep::values(std::int64_t i) const {
    std::vector<TomlNode> out;
    const std::vector<VariedParameter>& parameters = file_.parameters;
    if (file_.settings.sampling == Sampling::random) {
        for (std::size_t p = 0; p < parameters.size(); ++p)
            out.push_back(drawn(parameters[p], mixed(static_cast<std::uint64_t>(file_.settings.seed),
                                                     static_cast<std::uint64_t>(i), p)));
        return out;
    }
    out.resize(parameters.size());
    auto rest = static_cast<std::size_t>(i);
    for (std::size_t p = parameters.size(); p-- > 0;) {
        const std::vector<TomlNode>& values = parameters[p].values;
        out[p] = values[rest % values.size()];
        rest /= values.size();
    }
    return out;
}

std::vector<rack::TomlLine> Sweep::rack_lines(const std::vector<TomlNode>& values) const {
    TomlNode root = rack_;
    for (std::size_t p = 0; p < values.size(); ++p)
        if (file_.parameters[p].kind == ParameterKind::rack)
            MOTIONRACK_ASSERT(rack::put_value(root, file_.parameters[p].path, values[p]));
    return rack::toml_lines(root);
}

std::string Sweep::program_text(const std::vector<TomlNode>& values) const {
    std::string out;
    for (std::size_t at = 0; at < program_.size();) {
        const std::size_t brace = std::min(program_.find('{', at), program_.size());
        out.append(program_, at, brace - at);
        at = brace;
        for (std::size_t p = 0; p < values.size() && at == brace; ++p) {
            if (file_.parameters[p].kind != ParameterKind::text) continue;
            const std::string word = "{" + file_.parameters[p].path[1] + "}";
            if (program_.compare(at, word.size(), word) != 0) continue;
            out += value_text(values[p]);
            at += word.size();
        }
        if (at == brace && at < program_.size()) out += program_[at++];
    }
    return out;
}

PointText Sweep::point(std::int64_t i) const {
    const std::vector<TomlNode> drawn_values = values(i);
    PointText out;
    out.rack = rack::toml_of(rack_lines(drawn_values));
    out.program = program_text(drawn_values);
    out.subprograms = subprograms_;
    out.tools = tools_;
    out.block_delete = file_.settings.block_delete;
    for (std::size_t p = 0; p < drawn_values.size(); ++p) {
        if (file_.parameters[p].kind == ParameterKind::fault) out.faults = words_of(drawn_values[p].text);
    }
    return out;
}

}  // namespace motionrack::sweep
