#include "support/shipped_cases.hpp"
#include "support/feb_text.hpp"
#include "support/named_boxes.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace synovia
{

using namespace mfem;

namespace
{
const std::string folder = std::string(SYNOVIA_SOURCE_DIR) + "/miniapps/cases/";

std::string ReadShipped(const std::string &name)
{
   return ReadText(folder + name + ".toml");
}

// Of one half of a layer on which a body slides along x.
NamedSerialMesh SlidingLayer()
{
   return {PlateMesh(0.0, 1.8, 0.0, 3.6, 1.0),
           {{"cartilage", {1}}},
           {{"bottom", {1}},
            {"symmetry_y", {2}},
            {"sides_x", {3, 5}},
            {"sides_y", {4}},
            {"top", {6}}}};
}

// Facets of thousands of mutants take time: a finer shape gets coarser ones,
// but what is refused for its facets stays as it is.
RigidShape Coarsened(RigidShape shape)
{
   constexpr real_t fine = 20.0;
   constexpr real_t refused = 1e3;
   const real_t extent = shape.type == RigidShape::Type::plane ? shape.edge
                         : shape.type == RigidShape::Type::cylinder
                            ? std::max(shape.radius, shape.height)
                            : shape.radius;
   const real_t facets = extent / shape.facet_size;
   if (facets > fine && facets < refused)
   {
      shape.facet_size = extent / fine;
   }
   return shape;
}

NamedMesh WithShapes(const NamedSerialMesh &bodies, const CaseFile &setup)
{
   std::vector<RigidShape> shapes;
   for (const RigidBodyCase &body : setup.rigid_bodies)
   {
      if (const std::optional<RigidShape> shape = body.Shape())
      {
         shapes.push_back(Coarsened(*shape));
      }
   }
   try
   {
      NamedSerialMesh all =
         AddShapes(bodies.mesh, bodies.regions, bodies.boundaries, shapes);
      return DistributeMesh(all.mesh, all.regions, all.boundaries,
                            MPI_COMM_WORLD);
   }
   catch (const Error &error) // on all ranks alike, as of a mesh in a file
   {
      throw Error(WhereIs(setup.places, "mesh.file") + ": " + error.what());
   }
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

NamedMesh &ShippedCase::MeshFor(const CaseFile &setup)
{
   if (bodies)
   {
      mesh = WithShapes(*bodies, setup);
   }
   return mesh;
}

std::vector<std::string> ShippedNames()
{
   std::vector<std::string> names;
   for (const auto &file : std::filesystem::directory_iterator(folder))
   {
      if (file.path().extension() == ".toml")
      {
         names.push_back(file.path().stem().string());
      }
   }
   std::sort(names.begin(), names.end());
   return names;
}

std::vector<ShippedCase> ShippedCases()
{
   std::vector<ShippedCase> cases;
   const auto add = [&](const std::string &name, NamedMesh mesh) {
      cases.push_back({name, ReadShipped(name), std::move(mesh)});
   };
   // With facets as coarse as will do, and keys that no shipped case has.
   const auto add_sliding =
      [&](const std::string &name, const std::string &more)
   {
      const std::string text = Replaced(ReadShipped(name), "radius = 10}",
                                        "radius = 10, facet_size = 5}") +
                               more;
      const NamedSerialMesh layer = SlidingLayer();
      cases.push_back(
         {name, text, WithShapes(layer, ParseCase(text, name)), layer});
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
   for (const std::string name :
        {"indentation", "indentation_finite", "indentation_hexahedra"})
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
   add("indentation_wedge", OneBox("cartilage",
                                   {{"bone", {1}},
                                    {"symmetry_y", {2}},
                                    {"top", {3}},
                                    {"symmetry_turned", {4}},
                                    {"punch", {6}}},
                                   3.0, 0.75));
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
        {"glenohumeral", "glenohumeral_finite", "glenohumeral_hexahedra",
         "glenohumeral_ligaments"})
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
   for (const std::string name :
        {"knee", "knee_finite", "knee_body_weight", "knee_stance"})
   {
      add(name, Knee());
   }
   add_sliding("migrating_contact",
               "[[rigid_body]]\nname = \"roller\"\n"
               "shape = {type = \"cylinder\", center = [0, 1, -8], "
               "axis = [0, 1, 0], radius = 2, height = 4, facet_size = 2}\n"
               "translation = [0, 0, 0]\nrotation = [0, 0, 0]\n"
               "[[rigid_body]]\nname = \"bore\"\n"
               "shape = {type = \"sphere\", center = [0, 0, -8], "
               "radius = 4, hollow = true, facet_size = 4}\n"
               "translation = [0, 0, 0]\nrotation = [0, 0, 0]\n");
   add_sliding("resting_contact",
               "[[rigid_body]]\nname = \"plate\"\n"
               "shape = {type = \"plane\", center = [0, 0, -2], "
               "normal = [0, 0, 1], edge = 4}\n"
               "translation = [0, 0, 0]\nrotation = [0, 0, 0]\n"
               "[[joint]]\nname = \"slide\"\nside = \"left\"\n"
               "proximal = {body = \"sphere\", origin = [0, 0, 11], "
               "flexion_axis = [1, 0, 0], long_axis = [0, 0, 1]}\n"
               "distal = {body = \"plate\", origin = [0, 0, -2]}\n");
   return cases;
}

} // namespace synovia
