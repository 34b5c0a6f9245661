// Reads the files of the page and answers requests for them.
#include <fmt/format.h>

#include <array>
#include <fstream>
#include <iterator>
#include <motionrack/frontends/server/page.hpp>
#include <utility>

namespace motionrack::server {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_size = 64 << 20;
constexpr std::size_t max_files = 2000;

constexpr std::array<std::pair<std::string_view, std::string_view>, 14> types = {{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".webmanifest", "application/manifest+json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"},
    {".md", "text/plain; charset=utf-8"},
}};

std::string type_of(const std::string& extension) {
    for (const auto& [name, type] : types)
        if (name == extension) return std::string(type);
    return "application/octet-stream";
}

constexpr std::string_view no_page = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Motionrack</title></head><body>
<h1>Motionrack</h1>
<p>The rack runs; its page has not been built. Start it with <code>./run serve</code>, which builds the page,
or name its folder with <code>--page FOLDER</code>.</p>
<p>Programs can ask at once: <a href="/api/openapi.json">/api/openapi.json</a> lists all of them.</p>
</body></html>
)";

}  // namespace

Page::Page() : Page(no_page) {}

Page::Page(std::string_view html) {
    files_["/"] = {type_of(".html"), "no-store", std::make_shared<const std::string>(html)};
}

Result<Page> Page::read(const fs::path& folder) {
    Page page;
    page.files_.clear();
    std::error_code error;
    std::uintmax_t size = 0;
    for (auto it = fs::recursive_directory_iterator(folder, error); !error && it != fs::recursive_directory_iterator();
         it.increment(error)) {
        if (!fs::is_regular_file(it->symlink_status())) continue;
        std::ifstream in(it->path(), std::ios::binary);
        std::string text((std::istreambuf_iterator<char>(in)), {});
        if (!in)
            return fail(ErrorKind::io, "This file of the page could not be read. Nothing was started.", {},
                        it->path().string());
        size += text.size();
        if (size > max_size || page.files_.size() >= max_files)
            return fail(
                ErrorKind::invalid_input,
                fmt::format("This folder has more than {} MiB or {} files, so it is not a page. Nothing was started.",
                            max_size >> 20, max_files),
                {}, folder.string());
        const std::string name = fmt::format("/{}", it->path().lexically_relative(folder).generic_string());
        // Names in assets/ contain a hash of the content, so browsers may cache these files for a year.
        const bool for_ever = name.rfind("/assets/", 0) == 0;
        page.files_[name == "/index.html" ? "/" : name] = {
            type_of(it->path().extension().string()), for_ever ? "public, max-age=31536000, immutable" : "no-cache",
            std::make_shared<const std::string>(std::move(text))};
    }
    if (error)
        return fail(ErrorKind::io,
                    fmt::format("The page's folder could not be read: {}. Nothing was started.", error.message()), {},
                    folder.string());
    if (page.find("/") == nullptr)
        return fail(ErrorKind::invalid_input,
                    "This folder has no index.html, so it is not a page. Nothing was started.", {}, folder.string());
    return page;
}

void Page::mount(std::string_view folder, const Page& other) {
    for (const auto& [name, file] : other.files_) {
        files_[fmt::format("{}{}", folder, name)] = file;
        if (name == "/") files_[fmt::format("{}/index.html", folder)] = file;
    }
}

const PageFile* Page::find(std::string_view path) const {
    const auto found = files_.find(path);
    return found == files_.end() ? nullptr : &found->second;
}

HttpAnswer file_answer(const Page& page, const std::string& method, std::string_view path) {
    if (method != "GET" && method != "HEAD") {
        HttpAnswer answer = http_error(405, "invalid_input", "The page needs the method GET.");
        answer.more.emplace_back("Allow", "GET, HEAD");
        return answer;
    }
    const PageFile* file = page.find(path);
    if (file == nullptr) return http_error(404, "invalid_input", "The page has no such file.");
    HttpAnswer answer;
    answer.type = file->type;
    answer.cache = file->cache;
    answer.body = file->text;
    return answer;
}

}  // namespace motionrack::server
