// The numbers of a document by their names, with what they may be: for programs that vary them.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/io/chosen_keys.hpp"

namespace hamilcar::io {

struct NamedNumber {
    std::string name;  // "axle.front.spring.rate_N_per_m", as set_key takes it
    double value;      // in the key's unit
    std::string unit;  // "N/m"; empty where dimensionless
    double min, max;   // in the key's unit; infinite where there is none
    bool min_included = true;
    bool is_whole = false;
    std::string meaning;      // empty where the key says it all
    bool is_default = false;  // the document leaves it out
};

// In the order of the file; those that it leaves out and that have a constant for a default come behind those that stand in
// the same table. Items of lists go by their names, else by their numbers.
std::vector<NamedNumber> numbers_in(const Node& document, const TableRecord& format);

// The document less the keys that others in it override, saying the same in another way: a file with what is left means the same.
Node without_overridden(const Node& document, const TableRecord& format);

}  // namespace hamilcar::io
