#include "sim/scene/scene.h"
#include "sim/scene/tables.h"

namespace lather {

std::string scene_schema() {
  Object schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Lather scene"}};
  for (auto& part : descriptor::object_schema(tables::scene().info(), tables::document_fields())) {
    schema.push_back(std::move(part));
  }
  schema.emplace_back("$defs", Object{{"shape", tables::shapes().schema()},
                                      {"motion", tables::motions().schema()},
                                      {"curve", tables::curves().schema()},
                                      {"material", tables::material_schema()}});
  return write_json(schema, 2) + "\n";
}

}  // namespace lather
