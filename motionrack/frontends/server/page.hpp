// The page's files, read once: what is asked for is looked up by its whole name, so that no name leads anywhere else.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <motionrack/base/result.hpp>
#include <string>
#include <string_view>

namespace motionrack::server {

struct PageFile {
    std::string type;   ///< "text/html; charset=utf-8"
    std::string cache;  ///< for Cache-Control
    std::shared_ptr<const std::string> text;
};

class Page {
  public:
    /// A page that says how the real one is made.
    Page();
    /// Regular files of a folder and its subfolders, links left out; index.html is "/". Errors: io, invalid_input (no
    /// index.html, more than 64 MiB or 2000 files).
    static Result<Page> read(const std::filesystem::path& folder);

    /// "/", "/assets/index-1a2b.js"; nullptr: there is none.
    const PageFile* find(std::string_view path) const;

  private:
    std::map<std::string, PageFile, std::less<>> files_;
};

}  // namespace motionrack::server
