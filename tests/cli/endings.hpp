// The program in a process of its own that is watched, stopped and killed.
#pragma once

#include <sys/wait.h>

#include <chrono>
#include <csignal>

#include "cli/program.hpp"

namespace hamilcar {

class Endings : public Program {
protected:
    // With standard output as a shell says it, ">&-" or ">/dev/full".
    Outcome run_into(const std::string& output, const std::string& words) const {
        const std::string command =
            "cd '" + folder_.string() + "' && '" + test::program_path() + "' " + words + " 2>err.txt " + output;
        const int status = std::system(command.c_str());
        return {WEXITSTATUS(status), "", contents(folder_ / "err.txt")};
    }
    pid_t start(std::vector<std::string> words) const {
        const pid_t child = fork();
        if (child != 0) return child;
        std::vector<char*> arguments;
        words.insert(words.begin(), "hamilcar");
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        if (chdir(folder_.c_str()) != 0 || !freopen("out.txt", "w", stdout) || !freopen("err.txt", "w", stderr)) {
            _exit(99);
        }
        execv(test::program_path().c_str(), arguments.data());
        _exit(99);
    }
    // The exit code, or -1 if it has not ended within the time.
    static int code_within(pid_t child, std::chrono::milliseconds time) {
        const auto until = std::chrono::steady_clock::now() + time;
        int status = 0;
        while (waitpid(child, &status, WNOHANG) == 0) {
            if (std::chrono::steady_clock::now() > until) {
                kill(child, SIGKILL);
                waitpid(child, &status, 0);
                return -1;
            }
            usleep(1000);
        }
        return WIFEXITED(status) ? WEXITSTATUS(status) : -2;
    }
    // Until the program catches signals, which takes it long where sanitizers look on.
    static void wait_for_its_handler(pid_t child) {
        const std::filesystem::path status = "/proc/" + std::to_string(child) + "/status";
        for (int i = 0; i < 2000; ++i) {
            const std::string text = contents(status), caught = "SigCgt:\t";
            const std::size_t at = text.find(caught);
            if (at == text.npos) return;
            if (std::stoull(text.substr(at + caught.size(), 16), nullptr, 16) >> (SIGINT - 1) & 1) return;
            usleep(5000);
        }
    }
    bool appears(const std::string& name) const {
        for (int i = 0; i < 2000 && !std::filesystem::exists(folder_ / name); ++i) usleep(5000);
        return std::filesystem::exists(folder_ / name);
    }
};

}  // namespace hamilcar
