#include "hamilcar/io/csv.hpp"

// Comma-separated rows of shortest round-trip numbers. Rows gather in a buffer; if the disk takes only part of it, the
// file is cut back to its last whole row, so what can be read of it is right. A kill within a write leaves what the system
// had taken, whole pages: no program can cut back after its own end.
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/results.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::size_t buffer_size = 1 << 16;  // [byte]

[[noreturn]] void fail(const std::string& path, const std::string& action) {
    throw Error(ExitCode::input_output, path + ": cannot " + action + ": " + std::strerror(errno));
}

void append_heading(std::string& text, const std::string& name, const std::string& unit) {
    append_csv_field(text, name + " [" + unit + "]");
}

class CsvWriter final : public ResultWriter {
public:
    CsvWriter(const std::string& path, const std::vector<Column>& columns)
        : path_(path),
          width_(columns.size()),
          file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666)) {
        if (file_ < 0) fail(path_, "open for writing");
        append_heading(pending_, "time", "s");
        for (const Column& column : columns) append_heading(pending_ += ',', column.name, column.unit);
        pending_ += '\n';
    }
    CsvWriter(const CsvWriter&) = delete;
    CsvWriter& operator=(const CsvWriter&) = delete;
    ~CsvWriter() override {
        try {
            close();
        } catch (const Error&) {  // who wants to know calls `close`
        }
    }

    void write(double time, std::span<const double> values) override {
        HAMILCAR_ASSERT(values.size() == width_);
        append_number(pending_, time);
        for (const double value : values) append_number(pending_ += ',', value);
        pending_ += '\n';
        if (pending_.size() >= buffer_size) flush();
    }

    void flush() override {
        std::string_view rest = pending_;
        while (!rest.empty()) {
            const ssize_t taken = ::write(file_, rest.data(), rest.size());
            if (taken < 0 && errno == EINTR) continue;
            if (taken < 0) give_up(pending_.size() - rest.size());
            rest.remove_prefix(static_cast<std::size_t>(taken));
        }
        on_disk_ += static_cast<off_t>(pending_.size());
        pending_.clear();
    }

    void close() override {
        if (file_ < 0) return;
        flush();
        if (::close(std::exchange(file_, -1)) != 0) fail(path_, "close");
    }

    void move_to(const std::string& path) override {
        flush();
        put_in_place(path_, path);
        path_ = path;
    }

private:
    // Only `taken` bytes of the pending rows reached the disk.
    [[noreturn]] void give_up(std::size_t taken) {
        const int cause = errno;
        const auto last_end = std::string_view(pending_).substr(0, taken).rfind('\n');
        const std::size_t whole = last_end == std::string_view::npos ? 0 : last_end + 1;
        const bool cut = ::ftruncate(file_, on_disk_ + static_cast<off_t>(whole)) == 0;
        ::close(std::exchange(file_, -1));
        const std::string first_lost = pending_.substr(whole, pending_.find_first_of(",\n", whole) - whole);
        const bool headings = on_disk_ == 0 && whole == 0;
        pending_.clear();
        errno = cause;
        fail(path_, (headings ? "write the headings" : "write row at t = " + first_lost + " s") +
                        (cut || taken == whole ? "" : " (the last row of the file is incomplete)"));
    }

    std::string path_;
    std::size_t width_;
    int file_;
    std::string pending_;  // whole rows
    off_t on_disk_ = 0;    // [byte]
};

}  // namespace

void append_csv_field(std::string& text, std::string_view field) {
    if (field.find_first_of(",\"\n") == std::string_view::npos) {
        text += field;
        return;
    }
    text += '"';
    for (const char c : field) text.append(c == '"' ? 2 : 1, c);
    text += '"';
}

std::vector<std::string_view> csv_fields(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') quoted = !quoted;
        if (i < line.size() && (quoted || line[i] != separator)) continue;
        std::string_view field = trimmed(line.substr(begin, i - begin));
        if (field.size() > 1 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
        fields.push_back(field);
        begin = i + 1;
    }
    return fields;
}

CsvText::CsvText(const std::vector<std::string>& headings) {
    for (const std::string& heading : headings) cell(heading);
    end_row();
}

void CsvText::separate() {
    if (!first_) text_ += ',';
    first_ = false;
}

CsvText& CsvText::cell(std::string_view text) {
    separate();
    append_csv_field(text_, text);
    return *this;
}

CsvText& CsvText::cell(double number, int digits) {
    separate();
    if (!std::isfinite(number)) return *this;
    text_ += digits == 0 ? fmt::format("{}", number) : fmt::format("{:.{}g}", number, digits);
    return *this;
}

std::unique_ptr<ResultWriter> open_csv(const std::string& path, const std::vector<Column>& columns) {
    expect_writable_place(path);
    auto writer = std::make_unique<CsvWriter>(path, columns);
    writer->flush();  // a disk that takes no headings is better known before the run than after
    return writer;
}

}  // namespace hamilcar::io
