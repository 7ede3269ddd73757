#include "hamilcar/io/shipped.hpp"

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

}  // namespace hamilcar::io
