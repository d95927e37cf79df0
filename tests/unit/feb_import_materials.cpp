// ranks: 1
//
// Materials of FEBio: fibers and ligaments along their axes, vessels, solids
// without fluid.

#include "support/feb_text.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/feb/feb_import.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
using Fate = FebReport::Fate;
} // namespace

TEST_CASE("Fibers refer to the axes of the frame")
{
   const FebImport import =
      ImportFeb(Replaced(FebColumn(), R"(<solid type="neo-Hookean">
				<density>1</density>
				<E>2</E>
				<v>0.1</v>
			</solid>)",
                         R"(<solid type="solid mixture">
				<solid type="neo-Hookean"><E>2</E><v>0.1</v></solid>
				<solid type="fiber-NH">
					<mu>3</mu>
					<fiber type="angles"><theta>90</theta><phi>90</phi></fiber>
				</solid>
				<solid type="ellipsoidal fiber distribution">
					<beta>2,2.5,3</beta>
					<ksi>4,5,6</ksi>
				</solid>
				<solid type="continuous fiber distribution">
					<fibers type="fiber-exp-pow">
						<alpha>8</alpha><beta>2</beta><ksi>2.25</ksi><mu>0</mu>
					</fibers>
					<distribution type="von-Mises-3d"><b>2</b></distribution>
					<scheme type="fibers-3d-fei"><resolution>1796</resolution></scheme>
				</solid>
			</solid>)"),
                "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   const MaterialCase &material = import.setup.materials[0];
   // The first axis is theta, the second r, the third z.
   CHECK(material.frame.axis == Point3{{1.0, 0.0, 0.0}});
   REQUIRE(material.solid.solids.size() == 4);
   const Point3 along = material.solid.solids[1].vectors.at("direction");
   CHECK(std::abs(along[0]) == Approx(1.0));
   CHECK(along[1] == Approx(0.0).margin(1e-12));
   CHECK(material.solid.solids[2].vectors.at("beta") ==
         Point3{{2.5, 2.0, 3.0}});
   CHECK(material.solid.solids[2].vectors.at("ksi") == Point3{{5.0, 4.0, 6.0}});
   const SolidCase &distribution = material.solid.solids[3];
   CHECK(distribution.parameters.at("b") == 2.0);
   CHECK(distribution.fibers.model == "fiber_exp_pow");
   CHECK(distribution.fibers.parameters.at("ksi") == 2.25);
   CheckCase(import.setup);
}

TEST_CASE("A ligament of FEBio is along the first of its axes")
{
   std::string text =
      Replaced(FebColumn(), "<solid type=\"neo-Hookean\">",
               "<mat_axis type=\"vector\"><a>0,1,0</a><d>-1,0,0</d></mat_axis>"
               "<solid type=\"PRLig\"><c1>90</c1><c2>160</c2><mu>0.025</mu>"
               "<v0>5.85</v0><m>-100</m><k>1.55</k>"
               "<mat_axis type=\"vector\"><a>0,0,1</a><d>1,0,0</d></mat_axis>");
   text = Replaced(text, "<E>2</E>", "");
   text = Replaced(text, "<v>0.1</v>", "");
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.materials.size() == 1);
   const MaterialCase &material = import.setup.materials[0];
   CHECK(material.solid.model == "prlig");
   CHECK(material.solid.parameters.at("v0") == 5.85);
   CHECK(material.solid.parameters.at("m") == -100.0);
   // Theta of the frame is the first of the material's axes, and z stays.
   const Point3 &direction = material.solid.vectors.at("direction");
   CHECK(std::abs(direction[1]) < 1e-12);
   CHECK(std::hypot(direction[0], direction[2]) == Approx(1.0));
   CHECK(material.frame.axis[1] == Approx(1.0));
}

TEST_CASE("Vessels of FEBio become a supply")
{
   const std::string permeability = "<permeability type=";
   const std::string text =
      Replaced(FebColumn(), permeability,
               "<solvent_supply type=\"Starling\"><kp>0.02</kp><pv>0.3</pv>"
               "</solvent_supply>" +
                  permeability);
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.materials.size() == 1);
   const FluidSupply supply = import.setup.materials[0].supply.Supply();
   CHECK(supply.kp == 0.02);
   CHECK(supply.pc == 0.3);
   const std::string other =
      Replaced(FebColumn(), permeability,
               "<solvent_supply type=\"other\"/>" + permeability);
   CHECK_THAT(ImportFeb(other, "model.feb").report.Text(Fate::unsupported),
              Catch::Matchers::Contains("there is Starling"));
}

TEST_CASE("A solid without fluid is an elastic region")
{
   std::string text = Replaced(
      FebColumn(), "\t</Material>",
      R"(		<material id="2" name="bone" type="isotropic elastic">
			<density>1</density><E>20</E><v>0.3</v>
		</material>
	</Material>)");
   text = Replaced(text, "\t\t\t<elem id=\"2\">", R"(		</Elements>
		<Elements type="hex8" name="upper">
			<elem id="2">)");
   text = Replaced(text, "\t</MeshDomains>",
                   R"(		<SolidDomain name="upper" mat="tissue"/>
	</MeshDomains>)");
   text = Replaced(text, "name=\"body\" mat=\"tissue\"",
                   "name=\"body\" mat=\"bone\"");
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.materials.size() == 2);
   const MaterialCase &bone = import.setup.materials[1];
   CHECK(bone.regions == std::vector<std::string>{"body"});
   CHECK_FALSE(bone.HasFluid());
   CHECK(bone.solid.model == "saint_venant_kirchhoff");
   CHECK(bone.solid_density == 0.0);
   CheckCase(import.setup);
   const FebImport other =
      ImportFeb(Replaced(text, "isotropic elastic", "multiphasic"), "a.feb");
   CHECK(other.report.Text(Fate::unsupported)
            .find("materials of the type \"multiphasic\" are not known") !=
         std::string::npos);
}

TEST_CASE("Mooney-Rivlin with fibers keeps its names")
{
   std::string text =
      Replaced(FebColumn(), "<solid type=\"neo-Hookean\">",
               "<solid type=\"trans iso Mooney-Rivlin\"><c1>2</c1><c2>0.5</c2>"
               "<c3>0.1</c3><c4>40</c4><c5>8</c5><lam_max>1.06</lam_max>"
               "<k>30</k><pressure_model>default</pressure_model>"
               "<fiber type=\"vector\">0,3,0</fiber>");
   text = Replaced(text, "<E>2</E>", "");
   text = Replaced(text, "<v>0.1</v>", "");
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   const SolidCase &solid = import.setup.materials[0].solid;
   CHECK(solid.model == "trans_iso_mooney_rivlin");
   CHECK(solid.parameters.at("c4") == 40.0);
   CHECK(solid.parameters.at("lam_max") == 1.06);
   CHECK(solid.parameters.at("k") == 30.0);
   // Theta of the frame is along x.
   const Point3 &direction = solid.vectors.at("direction");
   CHECK(direction[1] == Approx(0.0).margin(1e-12));
   CHECK(Length(direction) == Approx(1.0));
   CheckCase(import.setup);
   CHECK(ImportFeb(Replaced(text, ">default<", ">NIKE3D<"), "model.feb")
            .report.Text(Fate::unsupported)
            .find("pressure_model") != std::string::npos);
}
