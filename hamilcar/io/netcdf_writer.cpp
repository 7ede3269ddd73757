// netCDF classic with 64-bit offsets: everything along one unlimited dimension `time`, opened by xarray, MATLAB, Octave
// and Julia alike. The library writes variable by variable, so rows gather in a block that is stored column by column.
//
// A reader believes the number of records in the file's header, not the file's length. So what was flushed stays
// readable when the program is killed; after a full disk the number is set back to that of the last flush.
#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/netcdf_file.hpp"
#include "hamilcar/io/results.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::size_t rows_per_block = 256;
constexpr std::size_t file_buffer = 1 << 18;  // of the library; small ones cost ten times as much per row [byte]

using Attributes = std::vector<std::pair<std::string, std::string>>;

class NetcdfWriter final : public ResultWriter {
public:
    NetcdfWriter(const std::string& path, const std::vector<Column>& columns, const Attributes& attributes)
        : file_(path, NetcdfFile::Mode::create, file_buffer) {
        try {
            define(columns, attributes);
        } catch (const Error&) {
            file_.abort();
            throw;
        }
        block_.resize(variables_.size() * rows_per_block);
    }
    NetcdfWriter(const NetcdfWriter&) = delete;
    NetcdfWriter& operator=(const NetcdfWriter&) = delete;
    ~NetcdfWriter() override {
        try {
            close();
        } catch (const Error&) {  // who wants to know calls `close`
        }
    }

    void write(double time, std::span<const double> values) override {
        HAMILCAR_ASSERT(values.size() + 1 == variables_.size());
        if (pending_ == 0 && stored_ == flushed_) first_unflushed_ = time;
        double* cell = block_.data() + pending_;
        *cell = time;
        for (const double value : values) *(cell += rows_per_block) = value;
        if (++pending_ == rows_per_block) store_block();
    }

    void flush() override {
        store_block();
        check_row(nc_sync(file_.id()));
        flushed_ = stored_;
    }

    void close() override {
        if (!file_.is_open()) return;
        flush();
        file_.close();
    }

    // The library works on an open file, whatever its name.
    void move_to(const std::string& path) override {
        flush();
        put_in_place(file_.path(), path);
        file_.rename(path);
    }

private:
    void define(const std::vector<Column>& columns, const Attributes& attributes) {
        for (const auto& [name, text] : attributes) file_.set_text(NC_GLOBAL, name, text);
        const int dimension = file_.define_dimension("time", NC_UNLIMITED);
        define_variable(dimension, {"time", "s", "time since the start of the run"});
        for (const Column& column : columns) define_variable(dimension, column);
        int previous_fill = 0;
        file_.check(nc_set_fill(file_.id(), NC_NOFILL, &previous_fill), "turn off filling");
        file_.check(nc_enddef(file_.id()), "write the header");
        file_.check(nc_sync(file_.id()), "write the header");
    }

    void define_variable(int dimension, const Column& column) {
        variables_.push_back(file_.define_variable(column.name, NC_DOUBLE, {dimension}));
        file_.set_text(variables_.back(), "units", column.unit);
        file_.set_text(variables_.back(), "long_name", column.description);
        if (column.role != ChannelRole::none) {
            file_.set_text(variables_.back(), role_attribute, std::string(text(column.role)));
            file_.set_text(variables_.back(), role_of_attribute, column.of);
        }
    }

    void store_block() {
        const double* values = block_.data();
        for (const int variable : variables_) {
            check_row(nc_put_vara_double(file_.id(), variable, &stored_, &pending_, values));
            values += rows_per_block;
        }
        stored_ += pending_;
        pending_ = 0;
    }

    // The disk took no more: close, and let the header tell of what was flushed before.
    void check_row(int status) {
        if (status == NC_NOERR) return;
        file_.release();
        if (std::FILE* file = std::fopen(file_.path().c_str(), "r+b")) {
            const auto count = static_cast<std::uint32_t>(flushed_);
            const std::array<unsigned char, 4> big_endian{
                static_cast<unsigned char>(count >> 24), static_cast<unsigned char>(count >> 16),
                static_cast<unsigned char>(count >> 8), static_cast<unsigned char>(count)};
            std::fseek(file, 4, SEEK_SET);  // after 'C' 'D' 'F' and the version
            std::fwrite(big_endian.data(), 1, big_endian.size(), file);
            std::fclose(file);
        }
        file_.check(status, "write row at t = " + number_text(first_unflushed_) + " s");
    }

    NetcdfFile file_;
    std::vector<int> variables_;  // time first
    std::vector<double> block_;   // rows_per_block values of each variable, one variable after the other
    std::size_t pending_ = 0, stored_ = 0, flushed_ = 0;  // rows in the block, given to the library, on disk
    double first_unflushed_ = 0;                          // time of the first row not on disk [s]
};

}  // namespace

std::unique_ptr<ResultWriter> open_netcdf(const std::string& path, const std::vector<Column>& columns,
                                          const std::string& title, const Attributes& attributes) {
    Attributes all{{"title", title}, {"source", "Hamilcar " HAMILCAR_VERSION}};
    all.insert(all.end(), attributes.begin(), attributes.end());
    return std::make_unique<NetcdfWriter>(path, columns, all);
}

}  // namespace hamilcar::io
