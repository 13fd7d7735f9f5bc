using System;
using System.Collections.Generic;

namespace Collektive.Headless
{
    /// <summary>Order statistics.</summary>
    internal static class Quantiles
    {
        /// <summary>The smallest value that is not below the given part of all values (nearest rank); 0 for none. Sorts the list.</summary>
        internal static double Of(List<double> values, double quantile)
        {
            if (values.Count == 0) return 0;
            values.Sort();
            var rank = (int)Math.Ceiling(quantile * values.Count);
            return values[Math.Max(rank, 1) - 1];
        }
    }
}
