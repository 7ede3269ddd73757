#include "hamilcar/io/file_kind.hpp"

#include <filesystem>
#include <string_view>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/toml_document.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

struct KindText {
    std::string_view name, use;
};
KindText text_of(FileKind kind) {
    switch (kind) {
        case FileKind::vehicle:
            return {"a vehicle", "'hamilcar check' looks at it, and a scenario names it as its 'vehicle'"};
        case FileKind::scenario:
            return {"a scenario", "'hamilcar run' drives it; the vehicle is what it names as 'vehicle'"};
        case FileKind::study: return {"a study", "'hamilcar study' runs its variants"};
        case FileKind::tire: return {"a tire", "'hamilcar tire' shows it, and a vehicle names it in a [tire.NAME]"};
        case FileKind::measured_road: return {"a measured road", "a scenario names it in its [road]"};
        case FileKind::results: return {"results of a run", "'hamilcar view' shows them"};
        case FileKind::outcome: return {"the outcome of a maneuver", "'hamilcar compare' takes the folder it is in"};
        case FileKind::folder: return {"a folder", "name one of the files in it"};
        case FileKind::other: break;
    }
    return {"a file of another kind", ""};
}

FileKind kind_of_toml(const std::string& path) {
    try {
        const Node document = read_toml(path);
        if (document.find("parameter")) return FileKind::study;
        if (document.find("vehicle")) return FileKind::scenario;
        if (document.find("chassis") || document.find("axle")) return FileKind::vehicle;
    } catch (const Error&) {
        return FileKind::other;  // who wanted it says what is wrong with it
    }
    return FileKind::other;
}

}  // namespace

FileKind kind_of_file(const std::string& path) {
    std::error_code none;
    if (std::filesystem::is_directory(path, none)) return FileKind::folder;
    constexpr std::size_t enough = 4096;  // headings come first
    const std::string beginning = file_beginning(path, enough);
    const auto has = [&](std::string_view word) { return beginning.find(word) != beginning.npos; };
    if (beginning.starts_with("CDF") || beginning.starts_with("\x89HDF")) return FileKind::results;
    if (has("$ROAD_CRG") || (has("$CT") && has("REFERENCE_LINE"))) return FileKind::measured_road;
    if (has("[MDI_HEADER]") || has("FILE_TYPE") || (has("[MODEL]") && has("FITTYP"))) return FileKind::tire;
    if (beginning.starts_with("{") && has("\"maneuver\"")) return FileKind::outcome;
    return kind_of_toml(path);
}

void expect_kind(const std::string& path, FileKind wanted, const std::function<void()>& read) {
    try {
        read();
    } catch (const Error& error) {
        const FileKind kind = kind_of_file(path);
        if (kind == wanted || kind == FileKind::other) throw;
        const KindText is = text_of(kind);
        std::string message = path + ": this is " + std::string(is.name) + ", expected " +
                              std::string(text_of(wanted).name) + "; " + std::string(is.use);
        throw Error(kind == FileKind::folder ? ExitCode::input_output : ExitCode::bad_file, message);
    }
}

}  // namespace hamilcar::io
