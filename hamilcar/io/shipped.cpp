#include "hamilcar/io/shipped.hpp"

#include <algorithm>
#include <filesystem>

namespace hamilcar::io {

namespace {

// Where this program was put with what comes with it: "bin/hamilcar" beside "share/hamilcar", wherever both were moved to.
std::filesystem::path beside_program() {
    std::error_code unreadable;
    return std::filesystem::read_symlink("/proc/self/exe", unreadable).parent_path() / "../share/hamilcar";
}

std::string& chosen_folder() {
    static std::string folder;
    return folder;
}

}  // namespace

void set_shipped_folder(const std::string& folder) {
    chosen_folder() = folder;
}

std::optional<std::string> find_shipped(const std::string& name) {
    const std::string& chosen = chosen_folder();
    const std::filesystem::path first = chosen.empty() ? "." : chosen;  // what lies about is no part of a package
    const std::filesystem::path beside = chosen.empty() ? beside_program() : first;
    for (const std::filesystem::path& folder :
         {first, beside, std::filesystem::path(HAMILCAR_SOURCE_DATA), std::filesystem::path(HAMILCAR_INSTALLED_DATA)}) {
        if (folder.empty()) continue;
        std::string path = (folder / name).lexically_normal();
        std::error_code unreadable;
        if (std::filesystem::exists(path, unreadable)) return path;
    }
    return {};
}

std::vector<std::string> shipped_tires() {
    std::vector<std::string> names;
    const auto folder = find_shipped("vehicles/tires");
    if (!folder) return names;
    for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
        if (entry.path().extension() == ".tir") names.push_back(entry.path().stem());
    }
    std::ranges::sort(names);
    return names;
}

std::optional<std::string> find_tire(const std::string& path, const std::string& name) {
    std::error_code unreadable;
    if (std::filesystem::exists(path, unreadable)) return path;
    for (const std::string& tire : shipped_tires()) {
        if (name == tire || name == tire + ".tir") return find_shipped("vehicles/tires/" + tire + ".tir");
    }
    return {};
}

}  // namespace hamilcar::io
