// ranks: 1
#include <catch2/catch.hpp>
#include <dlfcn.h>

#include <random>
#include <string>
#include <vector>

// miniapps/blas/one_column.cpp, with which this program is linked, against
// products and solves that are written out.

extern "C"
{
   void sgemm_(const char *, const char *, const int *, const int *,
               const int *, const float *, const float *, const int *,
               const float *, const int *, const float *, float *, const int *);
   void dgemm_(const char *, const char *, const int *, const int *,
               const int *, const double *, const double *, const int *,
               const double *, const int *, const double *, double *,
               const int *);
   void strsm_(const char *, const char *, const char *, const char *,
               const int *, const int *, const float *, const float *,
               const int *, float *, const int *);
   void dtrsm_(const char *, const char *, const char *, const char *,
               const int *, const int *, const double *, const double *,
               const int *, double *, const int *);
}

namespace
{
void Product(const char *a, const char *b, int m, int n, int k, float alpha,
             const float *A, int lda, const float *B, int ldb, float beta,
             float *C, int ldc)
{
   sgemm_(a, b, &m, &n, &k, &alpha, A, &lda, B, &ldb, &beta, C, &ldc);
}
void Product(const char *a, const char *b, int m, int n, int k, double alpha,
             const double *A, int lda, const double *B, int ldb, double beta,
             double *C, int ldc)
{
   dgemm_(a, b, &m, &n, &k, &alpha, A, &lda, B, &ldb, &beta, C, &ldc);
}
void Solve(const char *side, const char *part, const char *a, const char *diag,
           int m, int n, float alpha, const float *A, int lda, float *B,
           int ldb)
{
   strsm_(side, part, a, diag, &m, &n, &alpha, A, &lda, B, &ldb);
}
void Solve(const char *side, const char *part, const char *a, const char *diag,
           int m, int n, double alpha, const double *A, int lda, double *B,
           int ldb)
{
   dtrsm_(side, part, a, diag, &m, &n, &alpha, A, &lda, B, &ldb);
}

template <typename Number>
std::vector<Number> RandomNumbers(int size, int seed)
{
   std::mt19937 generator(seed);
   std::uniform_real_distribution<Number> entry(-1, 1);
   std::vector<Number> numbers(size);
   for (Number &number : numbers)
   {
      number = entry(generator);
   }
   return numbers;
}

template <typename Number>
constexpr double accuracy = sizeof(Number) == 4 ? 1e-5 : 1e-13;
} // namespace

TEMPLATE_TEST_CASE("Products with one column and with more", "", float, double)
{
   constexpr int rows = 7;
   constexpr int most = 9; // leading dimension
   const int columns = GENERATE(1, 3);
   const int terms = GENERATE(0, 1, 5);
   const std::string of_a = GENERATE("N", "T");
   const std::string of_b = GENERATE("N", "T");
   const TestType beta = static_cast<TestType>(GENERATE(0.0, -0.5));
   CAPTURE(columns, terms, of_a, of_b, beta);
   const auto a = RandomNumbers<TestType>(most * most, 1);
   const auto b = RandomNumbers<TestType>(most * most, 2);
   const auto before = RandomNumbers<TestType>(most * most, 3);
   auto c = before;
   const TestType alpha = 2;
   Product(of_a.c_str(), of_b.c_str(), rows, columns, terms, alpha, a.data(),
           most, b.data(), most, beta, c.data(), most);
   for (int j = 0; j < most; j++)
   {
      for (int i = 0; i < most; i++)
      {
         double expected = before[i + most * j];
         if (i < rows && j < columns)
         {
            expected *= beta;
            for (int l = 0; l < terms; l++)
            {
               expected += alpha *
                           a[of_a == "N" ? i + most * l : l + most * i] *
                           b[of_b == "N" ? l + most * j : j + most * l];
            }
         }
         CHECK(c[i + most * j] == Approx(expected).margin(accuracy<TestType>));
      }
   }
}

TEMPLATE_TEST_CASE("Triangular solves with one column and with more", "", float,
                   double)
{
   constexpr int rows = 6;
   constexpr int most = 8;
   const int columns = GENERATE(1, 2);
   const std::string side = GENERATE("L", "R");
   const std::string part = GENERATE("L", "U");
   const std::string of_a = GENERATE("N", "T");
   const std::string diagonal = GENERATE("N", "U");
   const TestType alpha = static_cast<TestType>(GENERATE(1.0, -2.0));
   CAPTURE(columns, side, part, of_a, diagonal, alpha);
   const bool left = side == "L";
   const int size = left ? rows : columns;
   auto a = RandomNumbers<TestType>(most * most, 4);
   for (int i = 0; i < most; i++)
   {
      a[i + most * i] += 3;
   }
   const auto before = RandomNumbers<TestType>(most * most, 5);
   auto x = before;
   Solve(side.c_str(), part.c_str(), of_a.c_str(), diagonal.c_str(), rows,
         columns, alpha, a.data(), most, x.data(), most);
   const auto entry = [&](int i, int j) -> double
   {
      if (of_a == "T")
      {
         std::swap(i, j);
      }
      if (i == j)
      {
         return diagonal == "U" ? 1.0 : a[i + most * i];
      }
      return (i > j) == (part == "L") ? a[i + most * j] : 0.0;
   };
   for (int j = 0; j < columns; j++)
   {
      for (int i = 0; i < rows; i++)
      {
         double product = 0.0;
         for (int l = 0; l < size; l++)
         {
            product += left ? entry(i, l) * x[l + most * j]
                            : x[i + most * l] * entry(l, j);
         }
         CHECK(product == Approx(alpha * before[i + most * j])
                             .margin(30 * accuracy<TestType>));
      }
   }
}

TEST_CASE("Libraries find the program's routines first")
{
   for (const char *name : {"sgemm_", "dgemm_", "strsm_", "dtrsm_"})
   {
      CAPTURE(name);
      void *const first = dlsym(RTLD_DEFAULT, name);
      REQUIRE(first);
      Dl_info routine;
      Dl_info program;
      REQUIRE(dladdr(first, &routine) != 0);
      REQUIRE(dladdr(reinterpret_cast<void *>(&RandomNumbers<float>),
                     &program) != 0);
      CHECK(routine.dli_fbase == program.dli_fbase);
   }
}
