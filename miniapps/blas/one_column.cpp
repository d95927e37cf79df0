// Matrix routines of BLAS that hand on what has one column to those for
// vectors. MUMPS solves for one right side with xGEMM and xTRSM, for which
// OpenBLAS copies the matrix first: with its vector routines the solves take
// 70 % of the time, and a run in finite deformation 5 to 8 % less.
//
// For programs only: their own symbols come before those of shared libraries,
// so that all libraries of a program have these. What has more columns goes on
// to the BLAS, which must be a shared library (check.cpp).

#include <dlfcn.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace
{
using Int = const int *;
using Text = const char *;
/// Lengths of texts, which compilers of Fortran put behind all arguments.
using Length = std::size_t;

template <typename Number>
using Gemm = void(Text, Text, Int, Int, Int, const Number *, const Number *,
                  Int, const Number *, Int, const Number *, Number *, Int,
                  Length, Length);
template <typename Number>
using Trsm = void(Text, Text, Text, Text, Int, Int, const Number *,
                  const Number *, Int, Number *, Int, Length, Length, Length,
                  Length);
template <typename Number>
using Gemv = void(Text, Int, Int, const Number *, const Number *, Int,
                  const Number *, Int, const Number *, Number *, Int, Length);
template <typename Number>
using Trsv = void(Text, Text, Text, Int, const Number *, Int, Number *, Int,
                  Length, Length, Length);

/// The next one of that name behind the program's own.
template <typename Routine>
Routine *InLibrary(const char *name)
{
   void *const found = dlsym(RTLD_NEXT, name);
   if (!found)
   {
      std::fprintf(stderr, "synovia: error: no shared library has %s of BLAS\n",
                   name);
      std::abort();
   }
   return reinterpret_cast<Routine *>(found);
}

/// The library's routines.
template <typename Number>
struct Blas
{
   Gemm<Number> *gemm;
   Trsm<Number> *trsm;
   Gemv<Number> *gemv;
   Trsv<Number> *trsv;
};

const Blas<float> &Single()
{
   static const Blas<float> blas{
      InLibrary<Gemm<float>>("sgemm_"), InLibrary<Trsm<float>>("strsm_"),
      InLibrary<Gemv<float>>("sgemv_"), InLibrary<Trsv<float>>("strsv_")};
   return blas;
}

const Blas<double> &Double()
{
   static const Blas<double> blas{
      InLibrary<Gemm<double>>("dgemm_"), InLibrary<Trsm<double>>("dtrsm_"),
      InLibrary<Gemv<double>>("dgemv_"), InLibrary<Trsv<double>>("dtrsv_")};
   return blas;
}

bool IsPlain(Text transposed)
{
   return *transposed == 'N' || *transposed == 'n';
}

/// C = alpha op(A) op(B) + beta C.
template <typename Number>
void Multiply(const Blas<Number> &blas, Text of_a, Text of_b, Int m, Int n,
              Int k, const Number *alpha, const Number *a, Int lda,
              const Number *b, Int ldb, const Number *beta, Number *c, Int ldc)
{
   // Without terms xGEMV leaves the vector as it is, whatever beta.
   if (*n != 1 || *m <= 0 || *k <= 0)
   {
      blas.gemm(of_a, of_b, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc, 1, 1);
      return;
   }
   const int one = 1;
   const bool plain = IsPlain(of_a);
   blas.gemv(of_a, plain ? m : k, plain ? k : m, alpha, a, lda, b,
             IsPlain(of_b) ? &one : ldb, beta, c, &one, 1);
}

/// B = alpha op(A)^-1 B, or B = alpha B op(A)^-1.
template <typename Number>
void Solve(const Blas<Number> &blas, Text side, Text part, Text of_a,
           Text diagonal, Int m, Int n, const Number *alpha, const Number *a,
           Int lda, Number *b, Int ldb)
{
   const bool left = *side == 'L' || *side == 'l';
   if (*n != 1 || !left || *alpha != Number(1))
   {
      blas.trsm(side, part, of_a, diagonal, m, n, alpha, a, lda, b, ldb, 1, 1,
                1, 1);
      return;
   }
   const int one = 1;
   blas.trsv(part, of_a, diagonal, m, a, lda, b, &one, 1, 1, 1);
}
} // namespace

extern "C"
{
   void sgemm_(Text of_a, Text of_b, Int m, Int n, Int k, const float *alpha,
               const float *a, Int lda, const float *b, Int ldb,
               const float *beta, float *c, Int ldc)
   {
      Multiply(Single(), of_a, of_b, m, n, k, alpha, a, lda, b, ldb, beta, c,
               ldc);
   }

   void dgemm_(Text of_a, Text of_b, Int m, Int n, Int k, const double *alpha,
               const double *a, Int lda, const double *b, Int ldb,
               const double *beta, double *c, Int ldc)
   {
      Multiply(Double(), of_a, of_b, m, n, k, alpha, a, lda, b, ldb, beta, c,
               ldc);
   }

   void strsm_(Text side, Text part, Text of_a, Text diagonal, Int m, Int n,
               const float *alpha, const float *a, Int lda, float *b, Int ldb)
   {
      Solve(Single(), side, part, of_a, diagonal, m, n, alpha, a, lda, b, ldb);
   }

   void dtrsm_(Text side, Text part, Text of_a, Text diagonal, Int m, Int n,
               const double *alpha, const double *a, Int lda, double *b,
               Int ldb)
   {
      Solve(Double(), side, part, of_a, diagonal, m, n, alpha, a, lda, b, ldb);
   }
}
