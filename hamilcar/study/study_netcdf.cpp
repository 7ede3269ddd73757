// The table as netCDF classic: one dimension, `point`, and a variable for every parameter and figure.
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/netcdf_file.hpp"
#include "hamilcar/io/whole_file.hpp"
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

void write(const io::NetcdfFile& file, const StudyTable& table) {
    file.set_text(NC_GLOBAL, "title", table.name);
    file.set_text(NC_GLOBAL, "source", "Hamilcar " HAMILCAR_VERSION);
    file.set_text(NC_GLOBAL, "vehicle_file", table.vehicle);
    const int point = file.define_dimension("point", table.points.size());
    const std::vector<Variable> variables = variables_of(table);
    std::vector<int> ids;
    for (const Variable& variable : variables) {
        ids.push_back(file.define_variable(variable_name(variable.name), NC_DOUBLE, {point}));
        if (!variable.unit.empty()) file.set_text(ids.back(), "units", variable.unit);
        if (!variable.meaning.empty()) file.set_text(ids.back(), "long_name", variable.meaning);
    }
    file.check(nc_enddef(file.id()), "end its definitions");
    for (std::size_t i = 0; i < ids.size(); ++i) {
        file.check(nc_put_var_double(file.id(), ids[i], variables[i].values.data()), "write");
    }
}

}  // namespace

void write_study_netcdf(const std::string& path, const StudyTable& table) {
    const std::string beside = io::create_beside(path);
    io::NetcdfFile file(beside, io::NetcdfFile::Mode::create);
    try {
        write(file, table);
        file.close();
    } catch (const io::Error&) {
        file.abort();
        throw;
    }
    io::put_in_place(beside, path);
}

}  // namespace hamilcar
