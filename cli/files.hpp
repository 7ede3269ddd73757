// Files as commands need them: those that come with hamilcar, folders of results, pages, the browser that shows them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/folder_lock.hpp"

namespace hamilcar::cli {

// A file that comes with hamilcar: here, in the source or where it is installed; throws io::Error(input_output).
std::string shipped_file(const std::string& name);
// The file that was named, or the shipped 323i.
std::string vehicle_or_shipped(const std::string& file);
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
// "wrote ...", on standard output unless that is one JSON object.
void tell_written(bool json, const std::string& what);
// To standard output, or to a file where one is named.
void print_or_write(const std::string& file, const std::string& text);

}  // namespace hamilcar::cli
