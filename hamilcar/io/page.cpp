#include "hamilcar/io/page.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hamilcar/io/chart_json.hpp"
#include "hamilcar/io/column_json.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "the page reads little-endian columns");

// The numbers of a document, one block of bytes; the document refers to pieces of it.
class ColumnBlock {
public:
    template <class Number>
    json add(const std::vector<Number>& values) {
        json reference{
            {"type", sizeof(Number) == 8 ? "f64" : "f32"}, {"offset", bytes_.size()}, {"count", values.size()}};
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number));
        bytes_.resize((bytes_.size() + 7) / 8 * 8, '\0');
        return reference;
    }
    json add_single(const std::vector<double>& values) {
        std::vector<float> single(values.size());
        std::ranges::transform(values, single.begin(), [](double value) { return static_cast<float>(value); });
        return add(single);
    }
    std::string base64() const {
        static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        text.reserve((bytes_.size() + 2) / 3 * 4);
        for (std::size_t i = 0; i < bytes_.size(); i += 3) {
            const std::size_t count = std::min<std::size_t>(3, bytes_.size() - i);
            unsigned group = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                group = group << 8 | (k < count ? static_cast<unsigned char>(bytes_[i + k]) : 0u);
            }
            for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
        }
        return text;
    }

private:
    std::string bytes_;
};

json to_json(const Cell& cell) {
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    if (const auto* number = std::get_if<double>(&cell); number && std::isfinite(*number)) return *number;
    if (const auto* file = std::get_if<FileCell>(&cell)) return {{"text", file->text}, {"file", file->file}};
    return nullptr;
}

struct BlockJson {
    ColumnBlock& numbers;

    json operator()(const Heading& heading) const { return {{"kind", "heading"}, {"text", heading.text}}; }
    json operator()(const Paragraph& paragraph) const { return {{"kind", "text"}, {"text", paragraph.text}}; }
    json operator()(const Replay&) const { return {{"kind", "replay"}}; }
    json operator()(const Chart& chart) const {
        return chart_json<json>(chart, [this](const std::vector<double>& values) { return numbers.add(values); });
    }
    json operator()(const Verdicts& verdicts) const {
        return {{"kind", "verdicts"}, {"list", verdicts_json<json>(verdicts.list)}};
    }
    json operator()(const Table& table) const {
        json columns = json::array(), rows = json::array();
        for (const auto& [name, unit] : table.columns) columns.push_back({{"name", name}, {"unit", unit}});
        for (const auto& row : table.rows) {
            json cells = json::array();
            for (const Cell& cell : row) cells.push_back(to_json(cell));
            rows.push_back(cells);
        }
        return {{"kind", "table"}, {"title", table.title}, {"columns", columns}, {"rows", rows}};
    }
};

json run_json(const PageRun& run, ColumnBlock& numbers) {
    json channels = json::array(), tiles = json::array();
    for (std::size_t i = 0; i < run.columns.size(); ++i) {
        const bool single = is_motion(run.columns[i].role);
        json channel = column_json(run.columns[i]);
        channel["column"] = single ? numbers.add_single(run.values[i]) : numbers.add(run.values[i]);
        channels.push_back(std::move(channel));
    }
    for (const RoadTile& tile : run.tiles) {
        tiles.push_back({{"ix", tile.ix}, {"iy", tile.iy}, {"column", numbers.add(tile.heights)}});
    }
    return {{"name", run.name},
            {"file", run.file},
            {"channels", channels},
            {"scene", run.scene.empty() ? json(nullptr) : parse_json(run.scene)},
            {"tiles", tiles}};
}

// Nothing in the text can end the element that it stands in.
std::string script_safe(const json& document) {
    const std::string text = json_text(document, -1);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text) {
        if (c == '<') {
            safe += "\\u003c";
        } else {
            safe += c;
        }
    }
    return safe;
}

}  // namespace

std::string page_text(const Page& page) {
    ColumnBlock numbers;
    json blocks = json::array(), runs = json::array();
    for (const PageBlock& block : page.blocks) {
        const auto* chart = std::get_if<Chart>(&block);
        const auto empty = [](const Curve& curve) {
            return std::ranges::none_of(curve.y, [](double y) { return std::isfinite(y); });
        };
        const bool is_map = chart && !(chart->marks.empty() && chart->lines.empty());
        if (chart && !is_map && std::ranges::all_of(chart->curves, empty)) continue;
        blocks.push_back(std::visit(BlockJson{numbers}, block));
    }
    for (const PageRun& run : page.runs) runs.push_back(run_json(run, numbers));
    const json document{{"title", page.title},
                        {"subtitle", page.subtitle},
                        {"generator", "Hamilcar " HAMILCAR_VERSION},
                        {"blocks", blocks},
                        {"runs", runs}};

    constexpr std::string_view document_tag = R"(<script id="hamilcar-document" type="application/json">)";
    constexpr std::string_view columns_tag = R"(<script id="hamilcar-columns" type="text/plain">)";
    const std::string_view text = page_template();
    const std::size_t at_document = text.rfind(document_tag) + document_tag.size();
    const std::size_t at_columns = text.rfind(columns_tag) + columns_tag.size();
    std::string out(text.substr(0, at_document));
    out += script_safe(document);
    out += text.substr(at_document, at_columns - at_document);
    out += numbers.base64();
    out += text.substr(at_columns);
    return out;
}

void write_page(const std::string& path, const Page& page) {
    write_whole_file(path, {page_text(page)});
}

}  // namespace hamilcar::io
