// Paths of the files that were installed or built with the program.
#include <motionrack/frontends/cli/share_folder.hpp>
#include <motionrack/frontends/cli/terminal.hpp>

namespace motionrack::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view no_docs = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Motionrack documentation</title></head><body>
<h1>The documentation is not installed</h1>
<p>Install the package <code>motionrack-doc</code> where Motionrack was installed as a Debian package. In a source
tree run <code>packaging/docs</code>, which builds the site. Then start <code>motionrack serve</code> again.</p>
<p><a href="/">Back to the operator panel</a></p>
</body></html>
)";

}  // namespace

fs::path share_folder() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    return error ? fs::path() : program.parent_path().parent_path() / "share/motionrack";
}

bool has_index(const fs::path& folder) {
    std::error_code error;
    return !folder.empty() && fs::exists(folder / "index.html", error);
}

server::Page docs_for_panel() {
    const fs::path folder = share_folder() / "docs";
    if (!has_index(folder)) return server::Page(no_docs);
    Result<server::Page> site = server::Page::read(folder);
    if (site) return *site;
    print_warning(site.error().text() + " The panel's help has no documentation.");
    return server::Page(no_docs);
}

}  // namespace motionrack::cli
