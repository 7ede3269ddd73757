// Results as netCDF classic with 64-bit offsets: everything along one unlimited dimension `time`, opened by xarray, MATLAB, Octave
// and Julia alike. A row is a record of the file.
//
// A reader believes the number of records in the file's header, not the file's length. So what was flushed stays
// readable when the program is killed or the disk is full.
#include <utility>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/netcdf_file.hpp"
#include "hamilcar/io/results.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

NetcdfVariable variable_of(const Column& column) {
    NetcdfVariable out{.name = column.name, .dimensions = {0}};
    out.attributes = {{"units", column.unit}, {"long_name", column.description}};
    if (column.role != ChannelRole::none) {
        out.attributes.push_back({role_attribute, std::string(text(column.role))});
        out.attributes.push_back({role_of_attribute, column.of});
    }
    return out;
}

NetcdfHeader header_of(const std::vector<Column>& columns, std::vector<NetcdfAttribute> attributes) {
    NetcdfHeader out{.dimensions = {{"time", 0}}, .attributes = std::move(attributes)};
    out.variables.push_back(variable_of({"time", "s", "time since the start of the run"}));
    for (const Column& column : columns) out.variables.push_back(variable_of(column));
    return out;
}

class NetcdfWriter final : public ResultWriter {
public:
    NetcdfWriter(const std::string& path, const std::vector<Column>& columns, std::vector<NetcdfAttribute> attributes)
        : file_(path, header_of(columns, std::move(attributes))), columns_(columns.size()) {}
    NetcdfWriter(const NetcdfWriter&) = delete;
    NetcdfWriter& operator=(const NetcdfWriter&) = delete;
    ~NetcdfWriter() override {
        try {
            close();
        } catch (const Error&) {  // who wants to know calls `close`
        }
    }

    void write(double time, std::span<const double> values) override {
        HAMILCAR_ASSERT(values.size() == columns_);
        if (written_ == flushed_) first_unflushed_ = time;
        row_.clear();
        append_big_endian(row_, time);
        for (const double value : values) append_big_endian(row_, value);
        file_.write(row_, action());
        ++written_;
    }

    void flush() override {
        file_.flush(written_, action());
        flushed_ = written_;
    }

    void close() override {
        if (!file_.is_open()) return;
        flush();
        file_.close();
    }

    // The file is open, whatever its name.
    void move_to(const std::string& path) override {
        flush();
        put_in_place(file_.path(), path);
        file_.rename(path);
    }

private:
    std::string action() const { return "write row at t = " + number_text(first_unflushed_) + " s"; }

    NetcdfOutput file_;
    std::size_t columns_;
    std::string row_;                          // the latest, as it goes into the file
    std::uint64_t written_ = 0, flushed_ = 0;  // rows
    double first_unflushed_ = 0;               // time of the first row that is not on disk [s]
};

}  // namespace

std::unique_ptr<ResultWriter> open_netcdf(const std::string& path, const std::vector<Column>& columns,
                                          const std::string& title,
                                          const std::vector<std::pair<std::string, std::string>>& attributes) {
    std::vector<NetcdfAttribute> all{{"title", title}, {"source", "Hamilcar " HAMILCAR_VERSION}};
    for (const auto& [name, text] : attributes) all.push_back({name, text});
    return std::make_unique<NetcdfWriter>(path, columns, std::move(all));
}

}  // namespace hamilcar::io
