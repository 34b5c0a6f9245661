// image: makes, shows and checks configuration images of the IOFLEX02's array.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <memory>
#include <motionrack/cards/ioflex02/image.hpp>
#include <motionrack/frontends/cli/commands.hpp>
#include <motionrack/frontends/cli/exit_codes.hpp>
#include <motionrack/frontends/cli/program_files.hpp>
#include <motionrack/frontends/cli/terminal.hpp>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace motionrack::cli {

namespace {

namespace io = ioflex02;
using Bytes = std::vector<std::uint8_t>;

constexpr ReadLimit image_limit{io::max_image_file, "a configuration image"};
constexpr ReadLimit payload_limit{io::max_payload, "the payload of an image"};

struct ImageOptions {
    std::string file, output, project{io::position_project};
    unsigned ident = io::position_ident;
    std::vector<std::string> axes;
    bool json = false, hex = false;
};

Bytes bytes_of(std::string_view text) {
    return {text.begin(), text.end()};
}

// ---- make

/// Returns the word MODE after applying a word of the user: "reversed", "x2", "index_low", "filter=3".
Result<std::uint16_t> with_word(std::uint16_t mode, std::string_view word) {
    if (word == "reversed") return io::mode::REVERSED.set(mode, 1);
    if (word == "index_low") return io::mode::INDEX_LOW.set(mode, 1);
    if (word == "x4") return io::mode::EDGES.set(mode, 0);
    if (word == "x2") return io::mode::EDGES.set(mode, 1);
    if (word == "x1") return io::mode::EDGES.set(mode, 2);
    constexpr std::string_view filter = "filter=";
    unsigned samples = 0;
    if (word.substr(0, filter.size()) == filter) {
        const char* end = word.data() + word.size();
        const auto read = std::from_chars(word.data() + filter.size(), end, samples);
        if (read.ec == std::errc{} && read.ptr == end && samples <= 15) return io::mode::FILTER.set(mode, samples);
    }
    return fail(ErrorKind::invalid_input,
                fmt::format("An axis cannot count '{}'; it can be reversed, x4, x2, x1, index_low and filter=0 to "
                            "filter=15. No image was created.",
                            word));
}

/// Parses "1=reversed,x2" into the word MODE of the axis.
Result<void> set_axis(std::array<std::uint16_t, io::axis_count>& modes, std::string_view text) {
    if (text.size() < 3 || text[0] < '0' || text[0] > '3' || text[1] != '=')
        return fail(ErrorKind::invalid_input,
                    fmt::format("'{}' is not an axis with its words; write for instance --axis "
                                "1=reversed,x2 with an axis 0 to 3. No image was created.",
                                text));
    std::uint16_t& mode = modes[static_cast<std::size_t>(text[0] - '0')];
    for (std::string_view rest = text.substr(2); !rest.empty();) {
        const std::size_t comma = rest.find(',');
        MOTIONRACK_TRY(mode, with_word(mode, rest.substr(0, comma)));
        rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    }
    return {};
}

Result<Bytes> made(const ImageOptions& options) {
    io::ImageContent content;
    content.project = options.project;
    content.ident = static_cast<std::uint8_t>(options.ident);
    std::array<std::uint16_t, io::axis_count> modes{};
    for (const std::string& axis : options.axes) MOTIONRACK_CHECK(set_axis(modes, axis));
    for (std::size_t i = 0; i < modes.size(); ++i) {
        content.payload[2 * i] = static_cast<std::uint8_t>(modes[i]);
        content.payload[2 * i + 1] = static_cast<std::uint8_t>(modes[i] >> 8);
    }
    if (!options.file.empty()) {
        MOTIONRACK_TRY(const std::string more, read_text(options.file, payload_limit));
        content.payload.insert(content.payload.end(), more.begin(), more.end());
    }
    MOTIONRACK_TRY(const auto raw, io::raw_image(content));
    return io::compressed(raw);
}

/// Returns the file name as an identifier of C and Pascal.
std::string identifier(const std::filesystem::path& file) {
    std::string out = file.stem().string();
    for (char& c : out)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return out.empty() || std::isdigit(static_cast<unsigned char>(out[0])) != 0 ? "image_" + out : out;
}

/// Returns the bytes as constants, twelve per line.
std::string constants(const Bytes& image, std::string_view before_each) {
    std::string out;
    for (std::size_t i = 0; i < image.size(); ++i)
        out += fmt::format("{}{}{:02X}{}", i % 12 == 0 ? "\n    " : " ", before_each, image[i],
                           i + 1 < image.size() ? "," : "");
    return out;
}

/// Returns the content of the file according to its extension.
std::string file_text(const Bytes& image, const std::string& output) {
    const std::filesystem::path path(output);
    const std::string ending = path.extension().string();
    if (ending == ".h")
        return fmt::format("/* Made by motionrack image make. */\nstatic const unsigned char {}[{}] = {{{}}};\n",
                           identifier(path), image.size(), constants(image, "0x"));
    if (ending == ".inc" || ending == ".pas")
        return fmt::format("{{ Made by motionrack image make. }}\nconst\n  {}: array[0..{}] of Byte = ({});\n",
                           identifier(path), image.size() - 1, constants(image, "$"));
    return {image.begin(), image.end()};
}

int make(const ImageOptions& options) {
    if (!may_write({options.file}, {options.output})) return exit_refused;
    const Result<Bytes> image = made(options);
    if (!image) return report(image.error());
    const Result<void> written = write_text(options.output, file_text(*image, options.output));
    if (!written) return report(written.error());
    if (options.output != "-")
        fmt::print("{}: {} bytes, project \"{}\", version {:02X}h\n", options.output, image->size(), options.project,
                   options.ident);
    return exit_done;
}

// ---- show and check

std::string words_of(std::uint16_t mode) {
    const unsigned edges = io::mode::EDGES.get(mode);
    std::string out = edges == 0 ? "x4" : edges == 1 ? "x2" : "x1";
    if (io::mode::REVERSED.test(mode)) out += ",reversed";
    if (io::mode::INDEX_LOW.test(mode)) out += ",index_low";
    if (io::mode::FILTER.get(mode) != 0) out += fmt::format(",filter={}", io::mode::FILTER.get(mode));
    return out;
}

Result<io::ImageInfo> read_image(const ImageOptions& options, Bytes& file) {
    MOTIONRACK_TRY(const std::string text, read_text(options.file, image_limit));
    file = bytes_of(text);
    MOTIONRACK_TRY(const auto raw, io::unpacked(file));
    return io::inspect(raw);
}

int show(const ImageOptions& options) {
    Bytes file;
    const Result<io::ImageInfo> info = read_image(options, file);
    if (!info) return report(info.error());
    if (options.hex) return fmt::print("{}\n", io::hex_text(file)), exit_done;
    if (options.json) {
        nlohmann::ordered_json axes = nlohmann::json::array();
        for (const std::uint16_t mode : info->modes) axes.push_back(words_of(mode));
        const nlohmann::ordered_json all = {
            {"project", info->project},       {"ident", info->ident},
            {"payload_bytes", info->payload}, {"crc32", info->crc},
            {"file_bytes", file.size()},      {"axes", info->position() ? axes : nlohmann::ordered_json()}};
        fmt::print("{}\n", all.dump(2, ' ', true, nlohmann::json::error_handler_t::replace));
        return exit_done;
    }
    fmt::print("project   {}\nversion   {:02X}h\npayload   {} bytes, CRC-32 {:08X}h\nfile      {} bytes\n",
               info->project, info->ident, info->payload, info->crc, file.size());
    for (std::size_t i = 0; info->position() && i < info->modes.size(); ++i)
        fmt::print("axis {}    {}\n", i, words_of(info->modes[i]));
    return exit_done;
}

int check(const ImageOptions& options) {
    Bytes file;
    const Result<io::ImageInfo> info = read_image(options, file);
    if (!info) return report(info.error());
    const Result<void> fits = io::check_project(*info);
    if (!fits) return report(fits.error());
    fmt::print("Flex_Ok: version {:02X}h of the project \"{}\"\n", info->ident, info->project);
    return exit_done;
}

CLI::App* add_reader(CLI::App& group, const char* name, const char* what, ImageOptions& options) {
    CLI::App* command = group.add_subcommand(name, what);
    command->add_option("FILE", options.file, "image file written by image make, '-': standard input")->required();
    return command;
}

void add_make(CLI::App& group, const std::shared_ptr<ImageOptions>& o, Action& chosen) {
    CLI::App* command = group.add_subcommand("make", "Make an image");
    command->add_option("BITS", o->file,
                        "file whose bytes follow the axes' modes in the payload, such as a raw binary (*.RBF) of the "
                        "array's design system; the virtual array stores and ignores them");
    command
        ->add_option("-o,--output", o->output,
                     "file to write: *.h a constant for C, *.inc or *.pas one for Pascal, else the bytes; '-': "
                     "standard output")
        ->required();
    command->add_option("--project", o->project, "its name, 1 to 16 characters")->capture_default_str();
    command->add_option("--ident", o->ident, "its version, as GetIdent returns it; the unit accepts 37 (0x25)")
        ->check(CLI::Range(0, 255))
        ->capture_default_str();
    command
        ->add_option("--axis", o->axes,
                     "mode of an axis, for instance 1=reversed,x2; words: reversed, x4, x2, x1, index_low, "
                     "filter=0 to filter=15; repeat for more (default: x4)")
        ->allow_extra_args(false);
    command->footer(
        "Example: motionrack image make -o irc.bin --axis 0=reversed --axis 3=x2,filter=4\n"
        "Example: motionrack image make IRC.RBF -o irc.h\n"
        "It replaces lz77c and binobj: Configure loads it, in C, Pascal and Python.");
    command->callback([o, &chosen] { chosen = [o] { return make(*o); }; });
}

}  // namespace

void add_image(CLI::App& app, Action& chosen) {
    auto o = std::make_shared<ImageOptions>();
    CLI::App* group = app.add_subcommand("image", "Configuration images of the IOFLEX02: make, show, check");
    group->require_subcommand(1);
    group->footer("Example: motionrack image make -o irc.bin --axis 0=reversed");
    add_make(*group, o, chosen);
    CLI::App* s = add_reader(*group, "show", "Show the header of an image", *o);
    s->add_flag("--hex", o->hex, "print only its bytes, for the key image of a rack file");
    s->add_flag("--json", o->json, "print everything as JSON");
    s->footer("Example: motionrack image show irc.bin");
    s->callback([o, &chosen] { chosen = [o] { return show(*o); }; });
    CLI::App* c =
        add_reader(*group, "check", "Check whether Init would return Flex_Ok; else print the reason, exit code 2", *o);
    c->footer("Example: motionrack image check irc.bin");
    c->callback([o, &chosen] { chosen = [o] { return check(*o); }; });
}

}  // namespace motionrack::cli
