// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/report.h"

#include <algorithm>

namespace ode_ext::accuracy {
namespace {

constexpr std::size_t kNamed = 5;  // failures that are named

bool is_met(const Figure& figure) { return !figure.target || figure.target->met_by(figure.value); }

std::string text_of(const Figure& figure) {
  if (!figure.target) return "";
  char text[48];
  std::snprintf(text, sizeof text, "%s %g%s",
                figure.target->side == Target::Side::kAtMost ? "<=" : ">=", figure.target->bound,
                is_met(figure) ? "" : ", missed");
  return text;
}

void print_failures(const nlohmann::json& details, std::FILE* out) {
  if (!details.is_object() || !details.contains("failures")) return;
  const auto& failures = details.at("failures");
  const auto count = failures.at("count").get<std::size_t>();
  const std::size_t named = std::min(kNamed, count);
  for (std::size_t i = 0; i < named; ++i) {
    const auto what = failures.at("first")[i].at("what").get<std::string>();
    std::fprintf(out, "    ode_ext: %s\n", what.c_str());
  }
  if (named < count) std::fprintf(out, "    and %zu more\n", count - named);
}

}  // namespace

bool meets_targets(const Result& result) {
  const auto& figures = result.ode_ext.figures;
  return std::all_of(figures.begin(), figures.end(), is_met);
}

void print(const Result& result, std::FILE* out) {
  std::fprintf(out, "%s: %s\n", result.trial->name, result.trial->sentence);
  std::fprintf(out, "  %-66s %10s %10s  %s\n", "", "ode_ext", "stock ODE", "target");
  for (std::size_t i = 0; i < result.ode_ext.figures.size(); ++i) {
    const Figure &ours = result.ode_ext.figures[i], &stock = result.stock.figures[i];
    std::fprintf(out, "  %-66s %10.4g %10.4g  %s\n", ours.name.c_str(), ours.value, stock.value,
                 text_of(ours).c_str());
  }
  print_failures(result.ode_ext.details, out);
  if (result.stock_given_up > 0)
    std::fprintf(out, "    stock ODE failed an assertion of its own on %d pairs\n",
                 result.stock_given_up);
  std::fputs("\n", out);
  std::fflush(out);
}

nlohmann::json json_of(const Result& result) {
  nlohmann::json figures = nlohmann::json::array();
  for (std::size_t i = 0; i < result.ode_ext.figures.size(); ++i) {
    const Figure &ours = result.ode_ext.figures[i], &stock = result.stock.figures[i];
    nlohmann::json figure{{"name", ours.name}, {"ode_ext", ours.value}, {"stock", stock.value}};
    if (ours.target) {
      const bool most = ours.target->side == Target::Side::kAtMost;
      figure[most ? "at_most" : "at_least"] = ours.target->bound;
      figure["met"] = is_met(ours);
    }
    figures.push_back(figure);
  }
  return {{"trial", result.trial->name},
          {"figures", figures},
          {"stock_given_up", result.stock_given_up},
          {"details", {{"ode_ext", result.ode_ext.details}, {"stock", result.stock.details}}}};
}

}  // namespace ode_ext::accuracy
