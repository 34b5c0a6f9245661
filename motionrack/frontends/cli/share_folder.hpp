// Folders that were installed or built with this program.
#pragma once

#include <filesystem>
#include <motionrack/frontends/server/page.hpp>

namespace motionrack::cli {

/// Returns PREFIX/share/motionrack for the program PREFIX/bin/motionrack; empty if the program's own path is unknown.
std::filesystem::path share_folder();

/// Returns true if a folder has an index.html: a page of the panel, or the site of the documentation.
bool has_index(const std::filesystem::path& folder);

/// Returns the documentation for the panel's help: the installed site, or one page that says how to get it.
server::Page docs_for_panel();

}  // namespace motionrack::cli
