using System;
using System.Collections.Generic;

namespace Collektive.Headless
{
    /// <summary>Computes quantiles.</summary>
    internal static class Quantiles
    {
        /// <summary>Returns a quantile by the nearest-rank method; 0 for an empty list. Sorts the list.</summary>
        internal static double Of(List<double> values, double quantile)
        {
            if (values.Count == 0) return 0;
            values.Sort();
            var rank = (int)Math.Ceiling(quantile * values.Count);
            return values[Math.Max(rank, 1) - 1];
        }
    }
}
