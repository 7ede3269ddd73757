// Results on disk while the run goes on: one row of channel values at a time, to CSV and netCDF.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hamilcar/io/channel_role.hpp"

namespace hamilcar::io {

struct Column {
    std::string name;         // "chassis.position.y"
    std::string unit;         // "m"; "1" where dimensionless
    std::string description;  // one phrase, netCDF long_name
    ChannelRole role = ChannelRole::none;
    std::string of = {};  // whose role it is: "front_left.tire"; "" of the motor vehicle and its driver
};

// Attributes of a variable that hold a column's role and whose it is.
inline constexpr const char* role_attribute = "hamilcar_role";
inline constexpr const char* role_of_attribute = "hamilcar_role_of";

// A file that receives rows. A row is on its way to the disk when `write` returns and on it after `flush`;
// the file is readable by others after every flush. Throws Error(input_output) naming the path and the cause.
class ResultWriter {
public:
    virtual ~ResultWriter() = default;
    virtual void write(double time, std::span<const double> values) = 0;
    virtual void flush() = 0;
    virtual void close() = 0;  // flush, and report what a destructor could not
    // Flushes, then takes another name in this folder, in the place of what has it; rows go on.
    virtual void move_to(const std::string& path) = 0;
};

// `title` and further attributes become global attributes (netCDF) or nothing (CSV: the first row is `name [unit]` headings).
std::unique_ptr<ResultWriter> open_csv(const std::string& path, const std::vector<Column>& columns);
std::unique_ptr<ResultWriter> open_netcdf(const std::string& path, const std::vector<Column>& columns,
                                          const std::string& title,
                                          const std::vector<std::pair<std::string, std::string>>& attributes = {});

}  // namespace hamilcar::io
