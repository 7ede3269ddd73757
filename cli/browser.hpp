// The person's browser, started without a shell: no text of an address or a path is ever read as a command.
#pragma once

#include <string>

namespace hamilcar::cli {

// Shows a file, if there is a browser; otherwise a line says what to open.
void open_in_browser(const std::string& path);

// Shows an address that is a secret. Everybody on a computer can list its processes and their arguments, so the browser is
// given a page that its owner alone can read, and that leads there. The page is gone with this. The address is told nowhere.
class SecretPage {
public:
    SecretPage(const std::string& folder, const std::string& address);
    SecretPage(const SecretPage&) = delete;
    SecretPage& operator=(const SecretPage&) = delete;
    ~SecretPage();

private:
    std::string path_;
};

}  // namespace hamilcar::cli
