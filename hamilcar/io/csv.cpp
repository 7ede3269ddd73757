// Comma-separated rows of shortest round-trip numbers. Rows gather in a buffer; if the disk takes only part of it, the
// file is cut back to its last whole row, so what can be read of it is right.
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/number_text.hpp"
#include "hamilcar/io/results.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::size_t buffer_size = 1 << 16;  // [byte]

[[noreturn]] void fail(const std::string& path, const std::string& action) {
    throw Error(ExitCode::input_output, path + ": cannot " + action + ": " + std::strerror(errno));
}

// A field with a comma or a quotation mark in it is quoted (RFC 4180).
void append_heading(std::string& text, const std::string& name, const std::string& unit) {
    const std::string field = name + " [" + unit + "]";
    if (field.find_first_of(",\"\n") == std::string::npos) {
        text += field;
        return;
    }
    text += '"';
    for (const char c : field) text.append(c == '"' ? 2 : 1, c);
    text += '"';
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
        assert(values.size() == width_);
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
        if (std::rename(path_.c_str(), path.c_str()) != 0) fail(path, "put the file in its place");
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

std::unique_ptr<ResultWriter> open_csv(const std::string& path, const std::vector<Column>& columns) {
    expect_writable_place(path);
    auto writer = std::make_unique<CsvWriter>(path, columns);
    writer->flush();  // a disk that takes no headings is better known before the run than after
    return writer;
}

}  // namespace hamilcar::io
