// ranks: 1
//
// Each element of FEBio, with its nodes in the order of FEBio's manual, fills
// the volume that it should, and has the faces that sets of nodes name.

#include "support/feb_text.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/feb/feb_import.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

using namespace mfem;
using namespace synovia;

namespace
{
using Fate = FebReport::Fate;

// Nodes by the corners whose mean they are, from 1.
using Means = std::vector<std::vector<int>>;

struct Shape
{
   std::string type;
   std::vector<Point3> corners;
   Means means;
   real_t volume;
   int order;
   /// Of the lowest face, corners first; and a facet of another one.
   std::vector<int> bottom;
   std::string facet;
};

const std::vector<Point3> cube{
   {0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 1.0, 0.0}, {0.0, 1.0, 0.0},
   {0.0, 0.0, 3.0}, {2.0, 0.0, 3.0}, {2.0, 1.0, 3.0}, {0.0, 1.0, 3.0}};
const Means cube_edges{{1, 2}, {2, 3}, {3, 4}, {4, 1}, {5, 6}, {6, 7},
                       {7, 8}, {8, 5}, {1, 5}, {2, 6}, {3, 7}, {4, 8}};
const std::vector<Point3> pyramid{
   {0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 3.0}};
const Means pyramid_edges{{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}};
const std::vector<Point3> wedge{{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0},
                                {0.0, 1.0, 0.0}, {0.0, 0.0, 3.0},
                                {2.0, 0.0, 3.0}, {0.0, 1.0, 3.0}};
const Means wedge_edges{{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6},
                        {6, 4}, {1, 4}, {2, 5}, {3, 6}};

Means With(Means means, const Means &more)
{
   means.insert(means.end(), more.begin(), more.end());
   return means;
}

std::vector<Shape> Shapes()
{
   const std::string lid = R"(<quad4 id="1">5,6,7,8</quad4>)";
   const std::string slope = R"(<tri3 id="1">2,3,4</tri3>)";
   const std::string top = R"(<tri3 id="1">4,5,6</tri3>)";
   return {
      {"hex8", cube, {}, 6.0, 1, {1, 2, 3, 4}, lid},
      {"hex20", cube, cube_edges, 6.0, 2, {1, 2, 3, 4, 9, 10, 11, 12}, lid},
      {"hex27",
       cube,
       With(cube_edges, {{1, 2, 6, 5},
                         {2, 3, 7, 6},
                         {3, 4, 8, 7},
                         {4, 1, 5, 8},
                         {1, 2, 3, 4},
                         {5, 6, 7, 8},
                         {1, 2, 3, 4, 5, 6, 7, 8}}),
       6.0,
       2,
       {1, 2, 3, 4, 9, 10, 11, 12, 25},
       lid},
      {"tet4", pyramid, {}, 1.0, 1, {1, 2, 3}, slope},
      {"tet10", pyramid, pyramid_edges, 1.0, 2, {1, 2, 3, 5, 6, 7}, slope},
      {"penta6", wedge, {}, 3.0, 1, {1, 2, 3}, top},
      {"penta15", wedge, wedge_edges, 3.0, 2, {1, 2, 3, 7, 8, 9}, top}};
}

std::string Listed(const std::vector<int> &numbers)
{
   std::string text;
   for (const int number : numbers)
   {
      text += (text.empty() ? "" : ",") + std::to_string(number);
   }
   return text;
}

// The column, of one element of a shape.
std::string OneElement(const Shape &shape)
{
   std::vector<Point3> nodes(shape.corners);
   for (const std::vector<int> &corners : shape.means)
   {
      Point3 mean{{0.0, 0.0, 0.0}};
      for (const int corner : corners)
      {
         mean = Sum(mean, 1.0 / corners.size(), shape.corners[corner - 1]);
      }
      nodes.push_back(mean);
   }
   std::ostringstream mesh;
   std::vector<int> all;
   mesh << "<Mesh>\n<Nodes name=\"nodes\">\n";
   for (size_t i = 0; i < nodes.size(); i++)
   {
      all.push_back(static_cast<int>(i) + 1);
      mesh << "<node id=\"" << all.back() << "\">" << nodes[i][0] << ','
           << nodes[i][1] << ',' << nodes[i][2] << "</node>\n";
   }
   // The one in the middle of a hexahedron is on no face.
   const std::vector<int> outer(all.begin(),
                                all.begin() + std::min<size_t>(all.size(), 26));
   mesh << "</Nodes>\n<Elements type=\"" << shape.type
        << "\" name=\"body\"><elem id=\"1\">" << Listed(all)
        << "</elem></Elements>\n<NodeSet name=\"all\">" << Listed(outer)
        << "</NodeSet>\n<NodeSet name=\"bottom\">" << Listed(shape.bottom)
        << "</NodeSet>\n<Surface name=\"top\">" << shape.facet
        << "</Surface>\n</Mesh>";
   const std::string text = FebColumn();
   const size_t begin = text.find("<Mesh>");
   const std::string end = "</Mesh>";
   return text.substr(0, begin) + mesh.str() +
          text.substr(text.find(end) + end.size());
}
} // namespace

TEST_CASE("Elements keep their volumes and faces")
{
   for (const Shape &shape : Shapes())
   {
      CAPTURE(shape.type);
      const FebImport import = ImportFeb(OneElement(shape), "model.feb");
      CHECK(import.report.Text(Fate::unsupported) == "");
      CHECK(import.setup.space.order == shape.order);
      CheckCase(import.setup);
      const TemporaryDirectory directory;
      NamedMesh mesh =
         ReadGmsh(directory.Write("model.msh", import.mesh), MPI_COMM_WORLD);
      REQUIRE(mesh.Get().GetGlobalNE() == 1);
      CHECK(mesh.Get().GetElementVolume(0) == Approx(shape.volume));
      // A curved element has the volume of its corners only by chance.
      ElementTransformation &trans = *mesh.Get().GetElementTransformation(0);
      const IntegrationRule &rule =
         IntRules.Get(mesh.Get().GetElementGeometry(0), 6);
      real_t volume = 0.0;
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         trans.SetIntPoint(&rule.IntPoint(q));
         CHECK(trans.Jacobian().Det() > 0.0);
         volume += rule.IntPoint(q).weight * trans.Jacobian().Det();
      }
      CHECK(volume == Approx(shape.volume));
      CHECK(mesh.Boundary("bottom").Size() == 1);
      CHECK(mesh.Boundary("top").Size() == 1);
      CaseProblem problem(import.setup, mesh);
      CHECK_NOTHROW(problem.Get().Operator());
   }
}

TEST_CASE("What is no element that is read stops the import")
{
   Shape shape = Shapes()[0];
   shape.type = "pyra5";
   CHECK(ImportFeb(OneElement(shape), "model.feb")
            .report.Text(Fate::unsupported)
            .find("elements of the type \"pyra5\" are not known; there are "
                  "hex8, hex20, hex27, tet4, tet10, penta6, penta15") !=
         std::string::npos);
}
