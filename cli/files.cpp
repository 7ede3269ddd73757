#include "files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "hamilcar/io/file_kind.hpp"
#include "hamilcar/io/set_key.hpp"
#include "hamilcar/io/shipped.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::cli {

std::string shipped_file(const std::string& name) {
    if (const auto path = io::find_shipped(name)) return *path;
    throw io::Error(io::ExitCode::input_output,
                    name + ": not found here, in the source or where hamilcar is installed");
}

void add_vehicle_set(Command& command, VehicleChoice& choice) {
    command.add("--vehicle-set", choice.set, "a key of the vehicle with another value, KEY=VALUE; may be repeated");
}

io::Node vehicle_document(const VehicleChoice& choice) {
    io::Node document = io::read_toml(choice.file);
    for (const std::string& assignment : choice.set) io::set_key(document, assignment, choice.set_by);
    return document;
}

VehicleDescription read_vehicle(const VehicleChoice& choice) {
    VehicleDescription vehicle;
    io::expect_kind(choice.file, io::FileKind::vehicle, [&] {
        io::Node document = vehicle_document(choice);
        vehicle = io::read_vehicle(document);
    });
    return vehicle;
}

VehicleDescription read_vehicle_or_shipped(const VehicleChoice& choice) {
    return read_vehicle({vehicle_or_shipped(choice.file), choice.set, choice.set_by});
}

std::string vehicle_or_shipped(const std::string& file) {
    return file.empty() ? shipped_file("vehicles/bmw_323i.toml") : file;
}

std::map<std::string, std::vector<std::string>> tire_remarks(const VehicleDescription& vehicle) {
    std::map<std::string, std::vector<std::string>> files;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        if (const auto* magic = std::get_if<MagicFormulaDescription>(&wheel.tire)) files[magic->name] = magic->remarks;
    });
    return files;
}

void make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error || !std::filesystem::is_directory(path)) {
        throw io::Error(io::ExitCode::input_output,
                        fmt::format("{}: cannot create the output folder: {}", path,
                                    error ? error.message() : "a file of that name exists"));
    }
}

io::FolderLock take_folder(const std::string& path) {
    make_folder(path);
    return io::FolderLock(path);
}

void write_file(const std::string& path, const std::string& text) {
    io::write_whole_file(path, {text});
}

void check_output(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (!std::filesystem::exists(path) || extension == ".html" || extension == ".htm") return;
    throw io::Error(io::ExitCode::usage,
                    "--output: " + path + " is there and is no page: expected a new file, or .html");
}

void check_table_output(const std::string& path) {
    if (!std::filesystem::exists(path) || std::filesystem::path(path).extension() == ".csv") return;
    throw io::Error(io::ExitCode::usage, "--csv: " + path + " is there and is no table: expected a new file, or .csv");
}

void tell_written(bool json, const std::string& what) {
    if (!json) fmt::print("wrote {}\n", what);
}

void print_or_write(const std::string& file, const std::string& text) {
    if (file.empty()) {
        fmt::print("{}", text);
    } else {
        write_file(file, text);
    }
}

}  // namespace hamilcar::cli
