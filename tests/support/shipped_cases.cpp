#include "support/shipped_cases.hpp"
#include "support/feb_text.hpp"
#include "support/named_boxes.hpp"
#include "support/temporary_directory.hpp"

#include <array>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
std::string ReadShipped(const std::string &name)
{
   return ReadText(std::string(SYNOVIA_SOURCE_DIR) + "/miniapps/cases/" + name +
                   ".toml");
}

NamedMesh RingOfMeniscus()
{
   NamedBodies bodies;
   bodies.Add("tibial_cartilage", PlateMesh(8.0, 8.0, -2.0, 16.0, 2.0),
              {"tibial_cartilage_bone", "symmetry_y", "tibial_cartilage_rim",
               "tibial_cartilage_rim", "symmetry_x",
               "tibial_cartilage_contact"});
   bodies.Add("meniscus", ArcMesh(0.0, 0.0, M_PI / 2),
              {"meniscus_inferior", "symmetry_y", "meniscus_periphery",
               "symmetry_x", "meniscus_inner", "meniscus_superior"});
   bodies.Add("femoral_cartilage", PlateMesh(8.0, 8.0, 2.0, 16.0, 2.0),
              {"femoral_cartilage_contact", "symmetry_y",
               "femoral_cartilage_rim", "femoral_cartilage_rim", "symmetry_x",
               "femoral_cartilage_bone"});
   return bodies.Distribute();
}

NamedMesh Knee()
{
   const auto cartilage = [](const std::string &name, bool below)
   {
      const std::string rim = name + "_rim";
      const std::string contact = name + "_contact";
      const std::string bone = name + "_bone";
      return std::array<std::string, 6>{
         below ? bone : contact, rim, rim, rim, rim, below ? contact : bone};
   };
   NamedBodies bodies;
   bodies.Add("femoral_cartilage", PlateMesh(0.0, 0.0, 2.0, 90.0, 2.0),
              cartilage("femoral_cartilage", false));
   for (const std::string side : {"medial", "lateral"})
   {
      const real_t x = side == "medial" ? -22.0 : 22.0;
      const std::string tibia = "tibial_cartilage_" + side;
      const std::string meniscus = "meniscus_" + side;
      bodies.Add(tibia, PlateMesh(x, 0.0, -2.0, 40.0, 2.0),
                 cartilage(tibia, true));
      bodies.Add(meniscus, ArcMesh(x, M_PI / 2, 3 * M_PI / 2),
                 {meniscus + "_inferior", meniscus + "_horn_anterior",
                  meniscus + "_periphery", meniscus + "_horn_posterior",
                  meniscus + "_inner", meniscus + "_superior"});
   }
   return bodies.Distribute();
}
} // namespace

std::vector<ShippedCase> ShippedCases()
{
   std::vector<ShippedCase> cases;
   const auto add = [&](const std::string &name, NamedMesh mesh) {
      cases.push_back({name, ReadShipped(name), std::move(mesh)});
   };
   for (const std::string variant : {"", "_finite"})
   {
      add("confined_compression" + variant,
          OneBox("cartilage",
                 {{"bottom", {1}},
                  {"top", {6}},
                  {"sides_x", {3, 5}},
                  {"sides_y", {2, 4}}},
                 0.2, variant.empty() ? 0.75 : 1.0));
      // Keys that no shipped case has.
      cases.back().text =
         Replaced(cases.back().text, "[[material]]\n",
                  "[[material]]\nsupply = {model = \"starling\", kp = 0.1, "
                  "pc = 0.2}\n") +
         "[[output.log]]\nfile = \"log.txt\"\nof = \"nodes\"\n"
         "data = [\"ux\", \"Rz\"]\nnumbers = [1, 2]\n"
         "surfaces = [\"top\"]\nregions = [\"cartilage\"]\n"
         "delimiter = \",\"\n";
      add("unconfined_compression" + variant, OneBox("cartilage",
                                                     {{"bottom", {1}},
                                                      {"top", {6}},
                                                      {"symmetry_x", {5}},
                                                      {"symmetry_y", {2}},
                                                      {"side", {3, 4}}},
                                                     1.5, 0.25));
   }
   add("relaxation_and_recovery", OneBox("cartilage",
                                         {{"bottom", {1}},
                                          {"top", {6}},
                                          {"sides_x", {3, 5}},
                                          {"sides_y", {2, 4}}},
                                         0.2, 0.75));
   add("two_columns", TwoBoxes("lower", "upper",
                               {{"lower_bottom", {1}},
                                {"lower_top", {6}},
                                {"lower_sides_x", {3, 5}},
                                {"lower_sides_y", {2, 4}},
                                {"upper_bottom", {7}},
                                {"upper_top", {12}},
                                {"upper_sides_x", {9, 11}},
                                {"upper_sides_y", {8, 10}}},
                               0.3, 0.3));
   add("osteochondral_core", TwoBoxes("bone", "cartilage",
                                      {{"bone_bottom", {1}},
                                       {"bone_top", {6}},
                                       {"bone_sides_x", {3, 5}},
                                       {"bone_sides_y", {2, 4}},
                                       {"cartilage_bottom", {7}},
                                       {"cartilage_top", {12}},
                                       {"cartilage_sides_x", {9, 11}},
                                       {"cartilage_sides_y", {8, 10}}},
                                      0.4, 0.4, 1.0));
   add("friction_plate", TwoBoxes("plate", "column",
                                  {{"plate_bottom", {1}},
                                   {"plate_top", {6}},
                                   {"plate_sides_x", {3, 5}},
                                   {"plate_sides_y", {2, 4}},
                                   {"column_bottom", {7}},
                                   {"column_top", {12}},
                                   {"column_sides_x", {9, 11}},
                                   {"column_sides_y", {8, 10}}},
                                  0.4, 0.4));
   for (const std::string name : {"indentation", "indentation_hexahedra"})
   {
      add(name, TwoBoxes("cartilage", "indenter",
                         {{"bone", {1}},
                          {"cartilage_top", {6}},
                          {"cartilage_side", {3, 4}},
                          {"symmetry_x", {5, 11}},
                          {"symmetry_y", {2, 8}},
                          {"indenter_bottom", {7}},
                          {"indenter_top", {12}},
                          {"indenter_side", {9, 10}}},
                         3.0, 0.75));
   }
   add("hertz", TwoBoxes("lower", "upper",
                         {{"lower_bottom", {1}},
                          {"lower_contact", {6}},
                          {"lower_sides", {3, 4}},
                          {"symmetry_x", {5, 11}},
                          {"symmetry_y", {2, 8}},
                          {"upper_contact", {7}},
                          {"upper_top", {12}},
                          {"upper_sides", {9, 10}}},
                         10.0, 10.0));
   for (const std::string name :
        {"glenohumeral", "glenohumeral_hexahedra", "glenohumeral_ligaments"})
   {
      add(name, TwoBoxes("glenoid", "humeral",
                         {{"glenoid_bone", {1}},
                          {"glenoid_contact", {6}},
                          {"glenoid_rim", {3, 4}},
                          {"symmetry_x", {5, 11}},
                          {"symmetry_y", {2, 8}},
                          {"humeral_contact", {7}},
                          {"humeral_bone", {12}},
                          {"humeral_rim", {9, 10}}},
                         10.0, 10.0, 1.5));
   }
   add("meniscus_ring", RingOfMeniscus());
   add("knee", Knee());
   return cases;
}

} // namespace synovia
