// Keys of a document that a person types over the file's: `--vehicle-set axle[front].spring.rate_N_per_m=30e3`.
#pragma once

#include <string>

#include "hamilcar/io/toml_document.hpp"

namespace hamilcar::io {

// "KEY=VALUE" put into `document` as if it stood in its file. A key goes as messages tell it, "axle[front].spring.rate_N_per_m",
// or with dots alone, "axle.front.spring.rate_N_per_m"; items of lists go by their names or by their numbers from 0 on. What is
// not there is added; the reader of the document says whether it may be there. `option` names the place in messages. Throws
// Error(usage) for what is no assignment or names an item that is not there.
void set_key(Node& document, const std::string& assignment, const std::string& option);
// The same of a value that is no text; `before` begins the messages.
void set_key(Node& document, const std::string& key, Node value, const std::string& before);

// What stands at a key, null where nothing does.
const Node* value_at(const Node& document, const std::string& key);

}  // namespace hamilcar::io
