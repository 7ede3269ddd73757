#include "hamilcar/io/key_survey.hpp"

#include <algorithm>

#include "hamilcar/io/key_recorder.hpp"
#include "hamilcar/io/key_schema.hpp"

namespace hamilcar::io {

namespace {

bool is_within(const TablePath& path, const TablePath& outer) {
    return path.size() >= outer.size() && std::equal(outer.begin(), outer.end(), path.begin());
}

// The lowest table that holds them all.
TablePath common_table(TablePath path, const std::vector<TablePath>& others) {
    for (const TablePath& other : others) {
        path.erase(std::ranges::mismatch(path, other).in1, path.end());
    }
    return path;
}

class Survey {
public:
    explicit Survey(const std::function<void(const TableReader&)>& read) : read_(read) {}

    // What is asked for under these answers, with the choices from the decision of number `first` on that are made
    // within the table `scope`.
    TableRecord explore(const Answers& answers, std::size_t first, const TablePath& scope) const {
        const Run base = run(answers);
        TableRecord record = base.record;
        for (std::size_t i = base.decisions.size(); i-- > first;) {  // the last is the innermost
            if (is_within(base.decisions[i].table, scope)) try_options(base, answers, i, scope, record);
        }
        return record;
    }

private:
    struct Run {
        TableRecord record;
        std::vector<Decision> decisions;
    };

    Run run(const Answers& answers) const {
        KeyRecorder recorder(answers);
        read_(TableReader(recorder));
        return {recorder.record(), recorder.decisions()};
    }

    static Answers turned(Answers answers, const Decision& decision, std::size_t option) {
        answers[decision.id()] = option;
        return answers;
    }

    // Adds to the record, which holds all later decisions within `explored`, what the other options of a decision of the
    // base's run lead to.
    void try_options(const Run& base, const Answers& answers, std::size_t number, const TablePath& explored,
                     TableRecord& record) const {
        const Decision& decision = base.decisions[number];
        std::vector<TableRecord> others;
        for (std::size_t option = 0; option < decision.options.size(); ++option) {
            if (option != decision.taken) others.push_back(run(turned(answers, decision, option)).record);
        }
        TablePath scope = decision.table;
        const bool changes_others = widen(scope, base.record, others, decision);
        const bool is_about_itself =
            decision.about == Decision::About::presence || decision.about == Decision::About::list;
        if (is_about_itself && !changes_others) {
            for (TableRecord& other : others) join_key(record, other, decision);
            return;
        }
        std::vector<TableRecord> variants =
            explore_options(decision, answers, number, {explored, base.record, record}, scope);
        variants[decision.taken] = record;
        for (TableRecord& variant : variants) variant = TableRecord(table_at(variant, scope));
        table_at(record, scope) = joined_by_choice(variants, decision, scope.size());
    }

    // What the option taken leads to: by itself, and with all later decisions within the scope.
    struct Taken {
        const TablePath& scope;
        const TableRecord &alone, &explored;

        TableRecord within(const TablePath& inner) const {
            TableRecord out = alone;
            TableRecord known = explored;
            table_at(out, inner) = TableRecord(table_at(known, inner));
            return out;
        }
    };

    // A word may matter only together with a later decision, and that one for tables beside: the scope grows until it
    // holds all that the options differ in. The option taken is not explored again where that is known: decisions inside
    // decisions would multiply.
    std::vector<TableRecord> explore_options(const Decision& decision, const Answers& answers, std::size_t number,
                                             const Taken& taken, TablePath& scope) const {
        for (;;) {
            std::vector<TableRecord> variants;
            for (std::size_t option = 0; option < decision.options.size(); ++option) {
                const bool known = option == decision.taken && is_within(scope, taken.scope);
                variants.push_back(known ? taken.within(scope)
                                         : explore(turned(answers, decision, option), number + 1, scope));
            }
            const std::size_t before = scope.size();
            widen(scope, variants[0], variants, decision);
            if (scope.size() == before) return variants;
        }
    }

    // Widens the scope to hold all tables in which others differ from the first, but for the deciding key itself;
    // whether there are any.
    static bool widen(TablePath& scope, const TableRecord& first, const std::vector<TableRecord>& others,
                      const Decision& decision) {
        bool any = false;
        for (const TableRecord& other : others) {
            const auto differing = differing_tables(first, other, decision.table, decision.key);
            any |= !differing.empty();
            scope = common_table(scope, differing);
        }
        return any;
    }

    static void join_key(TableRecord& to, TableRecord& other, const Decision& decision) {
        KeyRecord* key = table_at(to, decision.table).find(decision.key);
        join(*key, *table_at(other, decision.table).find(decision.key));
    }

    const std::function<void(const TableReader&)>& read_;
};

}  // namespace

TableRecord survey_keys(const std::function<void(const TableReader&)>& read) {
    return Survey(read).explore({}, 0, {});
}

}  // namespace hamilcar::io
