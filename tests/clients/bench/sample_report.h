// A small report that every part of the frame is tried on.
#pragma once

#include "clients/bench/report.h"

namespace skyig::tests {

inline clients::bench::Report sample_report() {
    using clients::bench::ModelEntry;
    clients::bench::Report report;
    report.family = "dials";
    report.title = "Dials & hands";
    report.cases = "every hour";
    report.truth = "a better dial";
    report.costs = "`read` looks once.";
    report.floor = "a glance";
    report.floor_ns = {1.9, 2.0, 2.125};
    report.rounds = 11;
    report.machine = "a machine";
    ModelEntry rough{"rough",
                     "one hand",
                     {{"hour", "day", "arcsec", {40.0, 20.0, 39.0, 24}},
                      {"minute", "day", "arcsec", {10.0, 5.0, 9.0, 24}}},
                     {{"read", {9.0, 10.0, 11.0}, {4.5, 5.0, 5.5}, 31.0}},
                     {{"face", 4096}, {"spring", 120}},
                     {{"day", "noon | sharp", "h", 12.0, 11.9, -360.0}}};
    ModelEntry fine{"fine",
                    "two | hands",
                    {{"hour", "day", "arcsec", {0.04, 0.02, 0.039, 24}},
                     {"minute", "day", "arcsec", {0.0, 0.0, 0.0, 24}},
                     {"hour", "night", "arcsec", {0.08, 0.04, 0.07, 12}}},
                    {{"read", {900.0, 1000.0, 1100.0}, {450.0, 500.0, 550.0}, {}}}};
    report.models = {rough, fine};
    report.plots = {
        {"hands", "Hands <of> a dial", "day", {{"hour", "hour", "read"}, {"minute", "minute", "read"}}}};
    report.curves = {{"noon",
                      "Towards <noon>",
                      "hours",
                      "light",
                      {{"a < b", {{0.0, 0.5}, {1.0, 0.0}, {10.0, 0.5}, {100.0, 2.0}}}}}};
    report.headline = {"hour", "day", "read"};
    return report;
}

}  // namespace skyig::tests
