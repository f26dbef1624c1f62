// A real browser without a screen, driven over a pipe by its DevTools protocol: no driver, no network.
#pragma once

#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/e2e/process.h"

namespace skyig::tests {

class Browser {
  public:
    /// Debian's chromium; false where it is not installed.
    [[nodiscard]] static bool installed();

    /// Starts it with one empty page. \throws std::runtime_error when it does not answer
    Browser();
    ~Browser();
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    void open(const std::string& url);
    void resize(int width_px, int height_px);
    /// The value of an expression in the page; of a promise, once it is kept. \throws std::runtime_error with
    /// the page's own words
    [[nodiscard]] nlohmann::json evaluate(const std::string& expression);
    /// Presses at one point of the page, goes to another in steps, and lets go there.
    void drag(double from_x, double from_y, double to_x, double to_y);
    /// Presses and lets go a key: "Tab", "ArrowRight".
    void press(const std::string& key);
    /// PNG bytes of what is seen, or of the whole page.
    [[nodiscard]] std::string screenshot(bool whole_page);

  private:
    [[nodiscard]] nlohmann::json call(const std::string& method, const nlohmann::json& parameters);
    [[nodiscard]] nlohmann::json read_message();
    void mouse(const std::string& type, double x, double y);

    ScratchDirectory profile_;
    pid_t pid_ = -1;
    int to_ = -1;
    int from_ = -1;
    std::string come_;
    int calls_ = 0;
    std::string session_;
};

}  // namespace skyig::tests
