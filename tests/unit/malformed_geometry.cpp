#include "malformed.hpp"

namespace ppm::test {

using nlohmann::json;

namespace {

constexpr const char* kPosition = "meshes[0].primitives[0].attributes.POSITION";

/// Copies of the mesh by these attributes.
std::function<void(json&)> copies(json attributes) {
  return [=](json& root) {
    root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
  };
}

/// A skin on the mesh.
std::function<void(json&)> skin(json joints, int binds) {
  return [=](json& root) {
    const std::size_t zeros = root["accessors"].size();
    root["accessors"].push_back(
        {{"bufferView", 0}, {"componentType", 5121}, {"type", "VEC4"}, {"count", 3}});
    root["skins"] = {{{"joints", joints}, {"inverseBindMatrices", binds}}};
    root["nodes"][0]["skin"] = 0;
    json& attributes = root["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = zeros;
    attributes["WEIGHTS_0"] = zeros;
  };
}

}  // namespace

std::vector<Malformed> malformed_geometry() {
  return {
      {"no count", drop("/accessors/1", "count"), "accessors[1].count", "is missing"},
      {"huge count", set("/accessors/1/count", 100000000000000), "accessors[1]", "needs"},
      {"count of 2^31", set("/accessors/1/count", 2147483648), "accessors[1]", "needs"},
      {"count of 2^32", set("/accessors/1/count", 4294967296), "accessors[1]", "needs"},
      {"count whose bytes wrap", set("/accessors/1/count", 1537228672809129302),
       "accessors[1].count", "is larger than any file"},
      {"count beyond all", set("/accessors/1/count", 1e30), "accessors[1].count",
       "is not a whole number"},
      {"count of 2^64 - 1", set("/accessors/1/count", 18446744073709551615u), "accessors[1].count",
       "is larger than any file"},
      {"negative count", set("/accessors/1/count", -3), "accessors[1].count", "is negative"},
      {"negative fraction", set("/accessors/0/count", -0.5), "accessors[0].count",
       "is not a whole number"},
      {"count a string", set("/accessors/1/count", "3"), "accessors[1].count",
       "is not a whole number"},
      {"no elements", set("/accessors/1/count", 0), "accessors[1]", "is empty"},
      {"huge count of zeros",
       set("/accessors/1", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4000000000}}),
       "accessors[1]", "without a bufferView"},
      {"offset beyond", set("/accessors/1/byteOffset", 4), "accessors[1]", "needs 40 bytes"},
      {"offset wraps", set("/accessors/1/byteOffset", 281474976710655), "accessors[1]", "needs"},
      {"offset negative", set("/accessors/1/byteOffset", -12), "accessors[1].byteOffset",
       "is negative"},
      {"no type", drop("/accessors/0", "type"), "accessors[0].type", "is missing"},
      {"no such type", set("/accessors/0/type", "VEC9"), "accessors[0].type",
       "is not a type of glTF"},
      {"type a number", set("/accessors/0/type", 3), "accessors[0].type", "is not a string"},
      {"matrix accessor", set("/accessors/0/type", "MAT2"), "accessors[0]", "holds"},
      {"no component type", drop("/accessors/0", "componentType"), "accessors[0].componentType",
       "is missing"},
      {"doubles", set("/accessors/0/componentType", 5130), "accessors[0].componentType",
       "is not a component type"},
      {"signed words", set("/accessors/0/componentType", 5124), "accessors[0].componentType",
       "is not a component type"},
      {"view out of range", set("/accessors/0/bufferView", 1000), "accessors[0].bufferView",
       "refers to bufferViews[1000]"},
      {"normalized a number", set("/accessors/0/normalized", 1), "accessors[0].normalized",
       "is neither true nor false"},
      {"least not a list", set("/accessors/0/min", 0), "accessors[0].min", "is not a JSON array"},

      {"sparse not an object", set("/accessors/0/sparse", 1), "accessors[0].sparse",
       "is not a JSON object"},
      {"sparse without indices", drop("/accessors/0/sparse", "indices"),
       "accessors[0].sparse.indices", "is missing"},
      {"sparse without values", drop("/accessors/0/sparse", "values"), "accessors[0].sparse.values",
       "is missing"},
      {"sparse without a view", drop("/accessors/0/sparse/values", "bufferView"),
       "accessors[0].sparse.values.bufferView", "is missing"},
      {"sparse counts backwards", set("/accessors/0/sparse/count", -1), "accessors[0].sparse.count",
       "is negative"},
      {"sparse of 2^31", set("/accessors/0/sparse/count", 2147483648), "accessors[0].sparse.count",
       "beyond 32 bits"},
      {"sparse of 2^32 + 1", set("/accessors/0/sparse/count", 4294967297),
       "accessors[0].sparse.count", "beyond 32 bits"},
      {"sparse beyond", set("/accessors/0/sparse/count", 4), "accessors[0].sparse",
       "substitutes more elements"},
      {"sparse reads outside", set("/accessors/0/sparse/count", 2), "accessors[0].sparse.indices",
       "needs 4 bytes of a bufferView of 2"},
      {"sparse offset backwards", set("/accessors/0/sparse/values/byteOffset", -4),
       "accessors[0].sparse.values.byteOffset", "is negative"},
      {"sparse offset of 2^32", set("/accessors/0/sparse/values/byteOffset", 4294967296),
       "accessors[0].sparse.values.byteOffset", "beyond 32 bits"},
      {"sparse view out of range", set("/accessors/0/sparse/indices/bufferView", 99),
       "accessors[0].sparse.indices.bufferView", "refers to bufferViews[99]"},
      {"sparse index type", set("/accessors/0/sparse/indices/componentType", 5126),
       "accessors[0].sparse.indices", "are not unsigned integers"},
      {"sparse index out of range", set("/accessors/0/sparse/indices/bufferView", 3),
       "accessors[0].sparse.indices", "do not increase"},

      {"scene out of range", set("/scene", 1), "scene", "refers to scenes[1]"},
      {"root out of range", set("/scenes/0/nodes/0", 9), "scenes[0].nodes[0]",
       "refers to nodes[9]"},
      {"root a string", set("/scenes/0/nodes/0", "1"), "scenes[0].nodes[0]",
       "is not a whole number"},
      {"no nodes", drop("", "nodes"), "scenes[0].nodes[0]", "refers to nodes[1]"},
      {"empty scene", set("/scenes/0/nodes", json::array()), "", "no triangles"},
      {"no mesh", drop("/nodes/0", "mesh"), "", "no triangles"},
      {"own parent", set("/nodes/0/children", {0}), "nodes[0]", "is reached twice"},
      {"cycle", set("/nodes/0/children", {1}), "nodes[1]", "is reached twice"},
      {"two parents", set("/nodes/2/children", {0}), "nodes[0]", "is reached twice"},
      {"listed twice", set("/scenes/0/nodes", {1, 1}), "nodes[1]", "is reached twice"},
      {"child out of range", set("/nodes/0/children", {77}), "nodes[0].children[0]",
       "refers to nodes[77]"},
      {"child below zero", set("/nodes/0/children", {-1}), "nodes[0].children[0]", "is negative"},
      {"child of 2^32", set("/nodes/0/children", {4294967296}), "nodes[0].children[0]",
       "is an integer beyond 32 bits"},
      {"child a node", set("/nodes/0/children", json::array({json::object()})),
       "nodes[0].children[0]", "is not a whole number"},
      {"children a number", set("/nodes/0/children", 2), "nodes[0].children",
       "is not a JSON array"},
      {"cycle of 100000 nodes",
       [](json& root) {
         for (int i = 3; i < 100003; ++i) root["nodes"].push_back({{"children", {i + 1}}});
         root["nodes"].back()["children"] = {1};
         root["nodes"][2]["children"] = {3};
       },
       "nodes[1]", "is reached twice"},

      {"short matrix", set("/nodes/0/matrix", {1, 2}), "nodes[0].matrix", "has 2 items"},
      {"matrix of 0", set("/nodes/0/matrix", json::array()), "nodes[0].matrix", "has 0 items"},
      {"projective matrix",
       set("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "nodes[0].matrix",
       "is not affine"},
      {"matrix of zeros", set("/nodes/0/matrix", std::vector<int>(16)), "nodes[0].matrix",
       "is not affine"},
      {"matrix that scales",
       set("/nodes/0/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2}), "nodes[0].matrix",
       "is not affine"},
      {"no rotation", set("/nodes/0/rotation", {0, 0, 0, 0}), "nodes[0].rotation",
       "is not a rotation"},
      {"rotation too large", set("/nodes/0/rotation", {1e308, 1e308, 1e308, 1e308}),
       "nodes[0].rotation", "is not a rotation"},
      {"rotation of strings", set("/nodes/0/rotation", {0, 0, 0, "1"}), "nodes[0].rotation[3]",
       "is not a number"},
      {"angles", set("/nodes/0/rotation", {0, 90, 0}), "nodes[0].rotation", "has 3 items"},
      {"scale null", set("/nodes/0/scale", {1, 1, nullptr}), "nodes[0].scale[2]",
       "is not a number"},
      {"scale a number", set("/nodes/0/scale", 2), "nodes[0].scale", "is not a JSON array"},
      {"translation of four", set("/nodes/0/translation", {0, 0, 0, 1}), "nodes[0].translation",
       "has 4 items"},
      {"overflow", set("/nodes/0/scale", {1e308, 1, 1}), "meshes[0].primitives[0]",
       "overflow in the world"},
      {"overflow of a chain",
       set("/nodes/1", {{"children", {0}},
                        {"matrix", {1e308, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e308, 0, 0, 1}}}),
       "meshes[0].primitives[0]", "overflow in the world"},
      {"too large", set("/nodes/0/scale", {1e20, 1, 1}), "", "extent is beyond"},
      {"too small", set("/nodes/0/scale", {1e-20, 1e-20, 1e-20}), "", "extent is beyond"},
      {"too far away", set("/nodes/0/translation", {1e300, 0, 0}), "nodes[1]",
       "camera is too far away"},
      {"no extent", set("/nodes/0/scale", {0, 0, 0}), "", "the scene has no extent"},
      {"only a line", set("/nodes/0/scale", {1, 0, 0}), "",
       "no triangle of the scene has any area"},

      {"mesh out of range", set("/nodes/0/mesh", 1), "nodes[0].mesh", "refers to meshes[1]"},
      {"no meshes", drop("", "meshes"), "nodes[0].mesh", "refers to meshes[0], but the file has 0"},
      {"no primitives", drop("/meshes/0", "primitives"), "meshes[0].primitives", "is missing"},
      {"empty mesh", set("/meshes/0/primitives", json::array()), "meshes[0].primitives",
       "is empty"},
      {"primitive a number", set("/meshes/0/primitives/0", 1), "meshes[0].primitives[0]",
       "is not a JSON object"},
      {"no attributes", drop("/meshes/0/primitives/0", "attributes"),
       "meshes[0].primitives[0].attributes", "is missing"},
      {"attributes a list", set("/meshes/0/primitives/0/attributes", {0}),
       "meshes[0].primitives[0].attributes", "is not a JSON object"},
      {"attribute a string", set("/meshes/0/primitives/0/attributes/NORMAL", "1"),
       "meshes[0].primitives[0].attributes.NORMAL", "is not a whole number"},
      {"mode", set("/meshes/0/primitives/0/mode", 7), "meshes[0].primitives[0].mode",
       "is not a topology"},
      {"mode a string", set("/meshes/0/primitives/0/mode", "TRIANGLES"),
       "meshes[0].primitives[0].mode", "is not a whole number"},
      {"no position accessor", set("/meshes/0/primitives/0/attributes/POSITION", 99), kPosition,
       "refers to accessors[99]"},
      {"no accessors",
       [](json& root) {
         root.erase("accessors");
         root["meshes"][0]["primitives"][0].erase("indices");
       },
       "meshes[0].primitives[0].attributes.POSITION", "the file has 0 of them"},
      {"position of two", set("/meshes/0/primitives/0/attributes/POSITION", 2), kPosition,
       "is not of type VEC3"},
      {"normal of two", set("/meshes/0/primitives/0/attributes/NORMAL", 2),
       "meshes[0].primitives[0].attributes.NORMAL", "has a type that this attribute cannot have"},
      {"colour of one", set("/meshes/0/primitives/0/attributes/COLOR_0", 4),
       "meshes[0].primitives[0].attributes.COLOR_0", "has a type that this attribute cannot have"},
      {"fewer normals", set("/accessors/1/count", 2), "meshes[0].primitives[0].attributes.NORMAL",
       "2 elements beside 3 positions"},
      {"signed indices", set("/accessors/4/componentType", 5122), "meshes[0].primitives[0].indices",
       "are not unsigned integers"},
      {"float indices", set("/meshes/0/primitives/0/indices", 0), "meshes[0].primitives[0].indices",
       "are not unsigned integers"},
      {"indices out of range", set("/meshes/0/primitives/0/indices", 99),
       "meshes[0].primitives[0].indices", "refers to accessors[99]"},
      {"indices without data", drop("/accessors/4", "bufferView"), "accessors[4].bufferView",
       "is missing"},
      {"four indices", set("/accessors/4/count", 4), "meshes[0].primitives[0]",
       "4 vertices do not make up whole triangles"},
      {"strip of two",
       [](json& root) {
         root["meshes"][0]["primitives"][0]["mode"] = 5;
         root["accessors"][4]["count"] = 2;
       },
       "meshes[0].primitives[0]", "2 vertices do not make up whole triangles"},
      {"index past the end", set("/accessors/4/bufferView", 2), "meshes[0].primitives[0].indices",
       "exceeds the 3 vertices"},
      {"largest index",
       [](json& root) {
         root["accessors"][4]["componentType"] = 5121;
         root["accessors"][4]["bufferView"] = 3;
       },
       "meshes[0].primitives[0].indices", "index 255 exceeds the 3 vertices"},
      {"material out of range", set("/meshes/0/primitives/0/material", 1),
       "meshes[0].primitives[0].material", "refers to materials[1]"},
      {"negative material", set("/meshes/0/primitives/0/material", -1),
       "meshes[0].primitives[0].material", "is negative"},
      {"copies by nothing", copies(json::object()),
       "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes", "is no object"},
      {"copies by a number", copies(1), "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes",
       "is no object"},
      {"copies by what is not there", copies({{"TRANSLATION", 99}}),
       "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.TRANSLATION",
       "refers to accessors[99]"},
      {"copies by two coordinates", copies({{"TRANSLATION", 2}}),
       "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.TRANSLATION", "has a type"},
      {"copies turned by angles", copies({{"ROTATION", 1}}),
       "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.ROTATION", "has a type"},
      {"copies in numbers that differ",
       [](json& root) {
         root["accessors"].push_back(root["accessors"][1]);
         root["accessors"].back()["count"] = 2;
         copies({{"SCALE", 1}, {"TRANSLATION", 5}})(root);
       },
       "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.TRANSLATION", "2 elements beside 3"},
      {"copies of zeros",
       [](json& root) {
         root["accessors"].push_back(
             {{"componentType", 5126}, {"type", "VEC3"}, {"count", 2000000000}});
         copies({{"TRANSLATION", 5}})(root);
       },
       "accessors[5]", "without a bufferView"},
      {"skin out of range", set("/nodes/0/skin", 0), "nodes[0].skin", "refers to skins[0]"},
      {"joint out of range",
       [](json& root) {
         skin({9}, 0)(root);
         root["skins"][0].erase("inverseBindMatrices");
       },
       "skins[0].joints[0]", "refers to nodes[9]"},
      {"no joints", skin(json::array(), 0), "skins[0].joints", "is empty"},
      {"binds that are no matrices", skin({0}, 1), "skins[0].inverseBindMatrices",
       "are not of type MAT4"},
      {"binds out of range", skin({0}, 77), "skins[0].inverseBindMatrices",
       "refers to accessors[77]"},
      {"joints without weights",
       [](json& root) {
         skin({0}, 1)(root);
         root["skins"][0].erase("inverseBindMatrices");
         root["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
       },
       "meshes[0].primitives[0].attributes", "has one of JOINTS_0 and WEIGHTS_0 only"},
      {"morph target out of range",
       [](json& root) {
         root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 99}}};
       },
       "meshes[0].primitives[0].targets[0].POSITION", "refers to accessors[99]"},
      {"morph target of fewer",
       [](json& root) {
         root["accessors"].push_back(root["accessors"][1]);
         root["accessors"].back()["count"] = 2;
         root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 5}}};
       },
       "meshes[0].primitives[0].targets[0].POSITION", "2 elements beside 3"},
      {"targets a number", set("/meshes/0/primitives/0/targets", 1),
       "meshes[0].primitives[0].targets", "is not a JSON array"},
      {"target a list", set("/meshes/0/primitives/0/targets", json::array({json::array()})),
       "meshes[0].primitives[0].targets[0]", "is not a JSON object"},
      {"weights of names", set("/meshes/0/weights", {"a"}), "meshes[0].weights[0]",
       "is not a number"},
      {"more zeros than bytes",
       set("/accessors/1", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 16777215}}),
       "accessors[1]", "without a bufferView"},
      {"triangle bomb",
       [](json& root) {
         // Zeros need no bytes: 1365 triangles, 25000 times over.
         root["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4095}};
         root["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}}}};
         for (int i = 0; i < 25000; ++i) {
           root["nodes"].push_back({{"mesh", 0}});
           root["scenes"][0]["nodes"].push_back(root["nodes"].size() - 1);
         }
       },
       "", "the scene has more than 33554432 triangles"},
  };
}

}  // namespace ppm::test
