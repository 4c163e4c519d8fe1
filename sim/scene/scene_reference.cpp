#include "sim/scene/material_cards.h"
#include "sim/scene/scene.h"
#include "sim/scene/tables.h"

namespace lather {
namespace {

using descriptor::FieldInfo;
using descriptor::TableInfo;

/// Text inside a Markdown table cell.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

std::string default_of(const FieldInfo& field) {
  if (field.presence == descriptor::Presence::kRequired) return "required";
  if (!field.default_words.empty()) return cell(field.default_words);
  return field.default_value ? std::string("`").append(cell(write_json(*field.default_value))).append("`")
                             : "none";
}

std::string rows(const std::vector<FieldInfo>& fields) {
  if (fields.empty()) return "";
  std::string out = "| key | meaning | unit | default | allowed |\n|---|---|---|---|---|\n";
  for (const FieldInfo& f : fields) {
    out += "| `" + f.name + "` | " + cell(f.words) + " | " + f.unit + " | " + default_of(f) + " | " +
           cell(f.allowed) + " |\n";
  }
  return out + "\n";
}

std::string section(const TableInfo& table, const std::string& level = "## ") {
  return level + table.title + "\n\n" + table.words + "\n\n" + rows(table.fields);
}

template <class Tagged>
std::string family(const std::string& title, const std::string& words, const Tagged& tagged) {
  std::string out = "## " + title + "\n\n" + words + "\n\n";
  for (const auto& a : tagged.alternatives()) out += section(a.info, "### ");
  return out;
}

std::string cards() {
  std::string out =
      "## material cards\n\n| preset | what it is | source | density kg/m^3 | bulk_modulus Pa | "
      "shear_modulus Pa | "
      "yield_stress Pa | viscosity Pa s^h | flow_index | tear_threshold | recovery_time s |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const MaterialCard& card : all_material_cards()) {
    out += "| `" + card.name + "` | " + card.words + " | " + card.source;
    Object values;
    tables::herschel_bulkley().write_fields(card.parameters, values);
    tables::tearing().write_fields(card.tearing, values);
    for (const auto& [name, value] : values) out += " | " + write_json(value);
    out += " |\n";
  }
  return out;
}

}  // namespace

std::string scene_reference() {
  std::string out = "# Scene format\n\n";
  out += section(tables::scene().info());
  out += "Beside these:\n\n" + rows(tables::document_fields());
  out += section(tables::domain().info()) + section(tables::material().info());
  for (const tables::Model& model : tables::models()) out += section(model.info, "### ");
  out += section(tables::tearing().info(), "### ") + section(tables::phase().info(), "### ");
  out += family("curves", "Every curve has a `type`; c is the concentration, taken from 0 to 1.",
                tables::curves());
  out += section(tables::body().info()) + section(tables::mixture_part().info(), "### ");
  out += section(tables::emitter().info()) + section(tables::obstacle().info());
  out += section(tables::grip().info());
  out += family("shapes",
                "Every shape has a `type` and takes the keys of its placement beside its own:\n\n" +
                    rows(tables::shapes().common()),
                tables::shapes());
  out += family("motions", "Every motion has a `type`.", tables::motions());
  out += family(
      "probes",
      "Every probe has a `type` and takes these keys beside its own. Probes do not change the run: its steps "
      "and its bits are the same with and without them. Samples stand in the report and in "
      "`probes.csv`.\n\n" +
          rows(tables::probes().common()),
      tables::probes());
  out += section(tables::budget().info());
  out += section(tables::numerics().info()) + section(tables::resampling().info(), "### ") +
         section(tables::subgrid_removal().info(), "### ") + section(tables::mlsrk().info(), "### ") +
         section(tables::phase_numerics().info(), "#### ");
  out += section(tables::look().info());
  out += section(tables::camera().info(), "### ") + section(tables::output().info());
  return out + cards();
}

}  // namespace lather
