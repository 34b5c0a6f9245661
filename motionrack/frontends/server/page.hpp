// Files of the page, read once. Requests look up the whole name, so that no name leads outside the folder.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <motionrack/base/result.hpp>
#include <motionrack/frontends/server/http.hpp>
#include <string>
#include <string_view>

namespace motionrack::server {

struct PageFile {
    std::string type;   ///< "text/html; charset=utf-8"
    std::string cache;  ///< value of Cache-Control
    std::shared_ptr<const std::string> text;
};

class Page {
  public:
    /// A placeholder page that explains how to build the real one.
    Page();
    /// Makes a page whose only file is this index.html.
    explicit Page(std::string_view html);
    /// Reads the regular files of a folder and its subfolders, without links; index.html is "/". Errors: io,
    /// invalid_input (no index.html, more than 64 MiB or 2000 files).
    static Result<Page> read(const std::filesystem::path& folder);

    /// Adds the files of another page below a folder, "/docs"; its index.html is "/docs/" and "/docs/index.html".
    void mount(std::string_view folder, const Page& other);

    /// Finds a file by its whole path: "/", "/assets/index-1a2b.js"; nullptr if not found.
    const PageFile* find(std::string_view path) const;

  private:
    std::map<std::string, PageFile, std::less<>> files_;
};

/// Returns the file at a path; error answers: 404 (no such file), 405 (method other than GET and HEAD).
HttpAnswer file_answer(const Page& page, const std::string& method, std::string_view path);

}  // namespace motionrack::server
