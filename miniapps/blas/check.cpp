// Whether one_column.cpp finds the BLAS: exits with 0 if a product with two
// columns, which it hands on, comes out right.

extern "C" void dgemm_(const char *, const char *, const int *, const int *,
                       const int *, const double *, const double *, const int *,
                       const double *, const int *, const double *, double *,
                       const int *);

int main()
{
   const int two = 2;
   const double one = 1.0;
   const double zero = 0.0;
   const double a[4] = {1.0, 2.0, 3.0, 4.0};
   const double b[4] = {0.0, 1.0, 1.0, 0.0};
   double c[4];
   dgemm_("N", "N", &two, &two, &two, &one, a, &two, b, &two, &zero, c, &two);
   return c[0] == 3.0 && c[1] == 4.0 && c[2] == 1.0 && c[3] == 2.0 ? 0 : 1;
}
