#include "hamilcar/study/study_record.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json json_of(std::size_t point, std::size_t run, const RunResult& result) {
    Json figures = Json::array();
    for (const Figure& f : result.figures) {
        figures.push_back({f.name, f.unit, f.meaning, std::isfinite(f.value) ? Json(f.value) : Json(nullptr)});
    }
    return {{"point", point},
            {"run", run},
            {"figures", figures},
            {"passed", result.passed ? Json(*result.passed) : Json(nullptr)},
            {"failed", result.failed}};
}

void take_line(const Json& line, StudyResults& results) {
    RunResult result{.figures = {}, .passed = {}, .failed = line.at("failed")};
    for (const Json& f : line.at("figures")) {
        const double value = f.at(3).is_null() ? std::numeric_limits<double>::quiet_NaN() : f.at(3).get<double>();
        result.figures.push_back({f.at(0), f.at(1), f.at(2), value});
    }
    if (!line.at("passed").is_null()) result.passed = line.at("passed").get<bool>();
    results.at(line.at("point").get<std::size_t>()).at(line.at("run").get<std::size_t>()) = std::move(result);
}

}  // namespace

StudyRecord::StudyRecord(const std::string& path, std::uint64_t sum, StudyResults& results) : path_(path) {
    io::expect_writable_place(path);
    const Json heading = {{"study", sum}, {"program", "Hamilcar " HAMILCAR_VERSION}};
    const std::string text = fs::exists(path) ? io::read_whole_file(path, io::FileLimit::checkpoint) : "";
    std::size_t kept = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', kept)) {
        const Json line = io::parse_json<Json>(std::string_view(text).substr(kept, end - kept));
        if (kept == 0 && line != heading) {
            throw io::Error(io::ExitCode::usage, path +
                                                     ": results of another study, vehicle or version: expected another "
                                                     "folder (--output), or --again to do it anew");
        }
        try {
            if (kept > 0) take_line(line, results), ++found_;
        } catch (const std::exception&) {
            throw io::Error(io::ExitCode::bad_file, path + ": damaged: expected --again to do the study anew");
        }
        kept = end + 1;
    }
    if (kept < text.size()) fs::resize_file(path, kept);  // the line that the program was killed in
    file_.reset(std::fopen(path.c_str(), "ab"));
    if (!file_) throw io::Error(io::ExitCode::input_output, path + ": cannot write: " + std::strerror(errno));
    if (kept == 0) append(io::json_text(heading, -1));
}

void StudyRecord::add(std::size_t point, std::size_t run, const RunResult& result) {
    append(io::json_text(json_of(point, run, result), -1));
}

void StudyRecord::append(const std::string& line) {
    const std::string whole = line + "\n";
    const bool written = std::fwrite(whole.data(), 1, whole.size(), file_.get()) == whole.size();
    if (!written || std::fflush(file_.get()) != 0) {
        throw io::Error(io::ExitCode::input_output, path_ + ": cannot write: " + std::strerror(errno));
    }
}

}  // namespace hamilcar
