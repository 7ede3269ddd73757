// The table as netCDF classic: one dimension, `point`, and a variable for every parameter and figure.
#include "hamilcar/io/netcdf_file.hpp"
#include "hamilcar/study/study_table.hpp"

namespace hamilcar {

namespace {

struct Variable {
    std::string name, unit, meaning;
    std::vector<double> values;
};

// Words of a parameter as NaN: the CSV has them.
std::vector<Variable> variables_of(const StudyTable& table) {
    std::vector<Variable> out;
    for (std::size_t k = 0; k < table.parameters.size(); ++k) {
        out.push_back({"parameter." + table.parameters[k], "", "value of the parameter", {}});
        for (const StudyPoint& point : table.points) out.back().values.push_back(point.numbers[k]);
    }
    for (const StudyColumn& figure : table.figures) {
        out.push_back({figure.name, figure.unit, figure.meaning, figure.values});
    }
    for (std::size_t k = 0; k < table.runs.size(); ++k) {
        out.push_back({table.runs[k] + ": passed", "1", "1: all criteria are met, 0: not, -1: there is none", {}});
        for (const auto& passed : table.passed) out.back().values.push_back(!passed[k] ? -1 : *passed[k] ? 1 : 0);
    }
    out.push_back({"score", "1", "weighted distance from the best of every goal", table.scores});
    return out;
}

// netCDF takes no '/' in names.
std::string variable_name(std::string name) {
    for (char& c : name) {
        if (c == '/') c = '_';
    }
    return name;
}

}  // namespace

void write_study_netcdf(const std::string& path, const StudyTable& table) {
    io::NetcdfHeader header{.dimensions = {{"point", table.points.size()}}};
    header.attributes = {
        {"title", table.name}, {"source", "Hamilcar " HAMILCAR_VERSION}, {"vehicle_file", table.vehicle}};
    std::string bytes;
    for (const Variable& variable : variables_of(table)) {
        header.variables.push_back({.name = variable_name(variable.name), .dimensions = {0}});
        std::vector<io::NetcdfAttribute>& attributes = header.variables.back().attributes;
        if (!variable.unit.empty()) attributes.push_back({"units", variable.unit});
        if (!variable.meaning.empty()) attributes.push_back({"long_name", variable.meaning});
        for (const double value : variable.values) io::append_big_endian(bytes, value);
    }
    io::write_netcdf(path, header, bytes);
}

}  // namespace hamilcar
