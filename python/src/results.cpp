// What was recorded: rows of a run, column by column, and the page that shows them.
#include "hamilcar/io/result_file.hpp"

#include "hamilcar/io/page.hpp"
#include "python.hpp"

namespace hamilcar::python {

namespace {

NewNumbers column(const io::PageRun& run, std::size_t i) {
    return new_numbers(run.values[i], {run.values[i].size()});
}

io::PageRun read(const std::string& path) {
    io::ResultFile file = io::read_result(path);
    return {.name = file.title,
            .file = path,
            .columns = std::move(file.columns),
            .values = std::move(file.values),
            .scene = std::move(file.scene),
            .tiles = std::move(file.tiles)};
}

std::string page(const io::PageRun& run, const std::string& title, const std::string& subtitle) {
    io::Page page{.title = title, .subtitle = subtitle, .blocks = {io::Replay{}}, .runs = {run}};
    return io::page_text(page);
}

void write_netcdf(const io::PageRun& run, const std::string& path) {
    const std::vector<io::Column> columns(run.columns.begin() + 1, run.columns.end());
    std::vector<std::pair<std::string, std::string>> attributes;
    if (!run.scene.empty()) attributes.emplace_back(io::scene_attribute, run.scene);
    const auto file = io::open_netcdf(path, columns, run.name, attributes);
    std::vector<double> row(columns.size());
    for (std::size_t i = 0; i < run.values[0].size(); ++i) {
        for (std::size_t k = 0; k < row.size(); ++k) row[k] = run.values[k + 1][i];
        file->write(run.values[0][i], row);
    }
    file->close();
    if (!run.tiles.empty()) io::write_tiles(io::tiles_beside(path), run.tiles);
}

}  // namespace

void add_results(nb::module_& module) {
    nb::class_<io::PageRun>(module, "Rows", "Rows of a run, column by column; the first is the time.")
        .def_ro("name", &io::PageRun::name)
        .def_prop_ro("columns",
                     [](const io::PageRun& run) {
                         nb::list out;
                         for (const io::Column& one : run.columns) {
                             out.append(nb::make_tuple(one.name, one.unit, one.description));
                         }
                         return out;
                     })
        .def("column", &column, "number"_a)
        .def("page", &page, "title"_a, "subtitle"_a, nb::call_guard<nb::gil_scoped_release>(),
             "A page of HTML with the replay and the plots.")
        .def("write_netcdf", &write_netcdf, "path"_a, nb::call_guard<nb::gil_scoped_release>());
    module.def("read_rows", &read, "path"_a, nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace hamilcar::python
