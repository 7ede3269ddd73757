#include "hamilcar/run/validity_report.hpp"

#include <nlohmann/json.hpp>

namespace hamilcar {

using Json = nlohmann::ordered_json;

Json validity_json(const std::vector<ValidityWarning>& list) {
    Json out = Json::array();
    for (const ValidityWarning& w : list) {
        out.push_back({{"kind", w.kind},
                       {"where", w.where},
                       {"quantity", w.quantity},
                       {"unit", w.unit},
                       {"worst", w.worst},
                       {"limit", w.limit},
                       {"time_s", w.time},
                       {"from_s", w.from},
                       {"to_s", w.to},
                       {"meaning", w.meaning},
                       {"advice", w.advice},
                       {"drive", w.drive}});
    }
    return out;
}

std::vector<ValidityWarning> validity_of(const Json& json) {
    std::vector<ValidityWarning> out;
    for (const Json& w : json) {
        out.push_back({.kind = w.at("kind"),
                       .where = w.at("where"),
                       .quantity = w.at("quantity"),
                       .unit = w.at("unit"),
                       .worst = w.at("worst"),
                       .limit = w.at("limit"),
                       .time = w.at("time_s"),
                       .from = w.at("from_s"),
                       .to = w.at("to_s"),
                       .meaning = w.at("meaning"),
                       .advice = w.at("advice"),
                       .drive = w.at("drive")});
    }
    return out;
}

void add_validity(const std::vector<ValidityWarning>& list, io::Page& page) {
    if (list.empty()) {
        page.blocks.push_back(
            io::Paragraph{"Validity: no model left its range, the step is stable and the energy "
                          "account balances as far as these were checked (docs/validity.md)."});
        return;
    }
    page.blocks.push_back(io::Heading{"Limits of validity"});
    io::Table table{"What was beyond the range of its model",
                    {{"where", ""},
                     {"what", ""},
                     {"worst", ""},
                     {"limit", ""},
                     {"unit", ""},
                     {"at", "s"},
                     {"from", "s"},
                     {"to", "s"},
                     {"meaning, and what to do", ""}},
                    {}};
    for (const ValidityWarning& w : list) {
        const std::string where = w.drive.empty() ? w.where : w.where + ", " + w.drive;
        table.rows.push_back(
            {where, w.quantity, w.worst, w.limit, w.unit, w.time, w.from, w.to, w.meaning + "; " + w.advice});
    }
    page.blocks.push_back(std::move(table));
}

}  // namespace hamilcar
