// Files as commands need them: those that come with hamilcar, folders of results, pages, the browser that shows them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "command.hpp"
#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/folder_lock.hpp"
#include "hamilcar/io/toml_document.hpp"

namespace hamilcar::cli {

// A file that comes with hamilcar: here, in the source or where it is installed; throws io::Error(input_output).
std::string shipped_file(const std::string& name);
// The file that was named, or the shipped 323i.
std::string vehicle_or_shipped(const std::string& file);
// A vehicle as the command line names it.
struct VehicleChoice {
    std::string file;
    std::vector<std::string> set;          // "KEY=VALUE", keys of the file with other values
    std::string set_by = "--vehicle-set";  // for messages; a file's path: paths among the values start from its folder
};
// --vehicle-set, which every command has that reads a vehicle.
void add_vehicle_set(Command& command, VehicleChoice& choice);
// With the keys that were set. Throws io::Error.
io::Node vehicle_document(const VehicleChoice& choice);
VehicleDescription read_vehicle(const VehicleChoice& choice);
// The same, of the shipped 323i where no file is named.
VehicleDescription read_vehicle_or_shipped(const VehicleChoice& choice);
// What the readers of a vehicle's tire property files remarked, by file.
std::map<std::string, std::vector<std::string>> tire_remarks(const VehicleDescription& vehicle);
// Creates a folder with its parents; throws io::Error(input_output).
void make_folder(const std::string& path);
// The same for a run's results: no other program writes there as long as the lock lives.
[[nodiscard]] io::FolderLock take_folder(const std::string& path);
// Writes a whole small file, complete or not at all; throws io::Error(input_output).
void write_file(const std::string& path, const std::string& text);
// Where a page may go: a page that takes a result's place would be a run lost. Throws io::Error(usage).
void check_output(const std::string& path);
// Where a table may go, likewise.
void check_table_output(const std::string& path);
// "wrote ...", on standard output unless that is one JSON object.
void tell_written(bool json, const std::string& what);
// To standard output, or to a file where one is named.
void print_or_write(const std::string& file, const std::string& text);

}  // namespace hamilcar::cli
