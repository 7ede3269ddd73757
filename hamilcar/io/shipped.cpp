#include "hamilcar/io/shipped.hpp"

#include <algorithm>
#include <filesystem>

namespace hamilcar::io {

std::optional<std::string> find_shipped(const std::string& name) {
    for (const char* folder : {".", HAMILCAR_SOURCE_DATA, HAMILCAR_INSTALLED_DATA}) {
        std::string path = std::filesystem::path(folder) / name;
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
