using System;
using System.Globalization;
using System.Numerics;

namespace Collektive.Headless
{
    /// <summary>Reads decimal numbers.</summary>
    internal static class ExactNumber
    {
        /// <summary>The midpoints of neighbouring doubles have fewer digits.</summary>
        private const int MaxDigits = 800;

        /// <summary>Reads a number like <c>double.TryParse</c>, but returns the nearest double, and -0 for "-0".</summary>
        /// <remarks>Mono returns a neighbouring double for some texts, and 0 for "-0".</remarks>
        internal static bool TryParse(string text, out double value)
        {
            if (!double.TryParse(text, NumberStyles.Float, CultureInfo.InvariantCulture, out value)) return false;
            if (double.IsNaN(value) || double.IsInfinity(value)) return true;
            var parts = text.Trim().Trim('\0').Split('e', 'E');
            var scale = 0L;
            if (parts.Length > 1 && !long.TryParse(parts[1], NumberStyles.AllowLeadingSign, CultureInfo.InvariantCulture, out scale)) return true;
            var isNegative = parts[0][0] == '-';
            var mantissa = parts[0].TrimStart('+', '-');
            var point = (mantissa + ".").IndexOf('.');
            mantissa = mantissa.Replace(".", "");
            var digits = mantissa.TrimStart('0');
            var exponent = scale + point - (mantissa.Length - digits.Length);
            digits = digits.TrimEnd('0');
            // One more digit represents all following ones, because no midpoint has that many.
            if (digits.Length > MaxDigits) digits = digits.Substring(0, MaxDigits) + "1";
            exponent -= digits.Length;
            var bits = 0L;
            if (digits.Length <= 15 && exponent >= -22 && exponent <= 22)
            {
                // Both numbers have exact values as double, so the result is rounded only once.
                var power = 1.0;
                for (var i = Math.Abs(exponent); i > 0; i--) power *= 10;
                double whole = digits.Length > 0 ? long.Parse(digits, CultureInfo.InvariantCulture) : 0;
                bits = BitConverter.DoubleToInt64Bits(exponent < 0 ? whole / power : whole * power);
            }
            // Smaller numbers are zero.
            else if (digits.Length > 0 && exponent > -2 * MaxDigits)
            {
                // Mono reads some texts with many digits as 0.
                var start = "." + digits.Substring(0, Math.Min(digits.Length, 17)) + "E" + (exponent + digits.Length);
                bits = BitConverter.DoubleToInt64Bits(double.Parse(start, CultureInfo.InvariantCulture));
                var number = BigInteger.Parse(digits, CultureInfo.InvariantCulture) * BigInteger.Pow(10, (int)Math.Max(exponent, 0));
                var divisor = BigInteger.Pow(10, (int)Math.Max(-exponent, 0));
                while (RoundsUp(number, divisor, bits)) bits++;
                while (bits > 0 && !RoundsUp(number, divisor, bits - 1)) bits--;
            }
            value = BitConverter.Int64BitsToDouble(isNegative ? bits | long.MinValue : bits);
            return true;
        }

        /// <summary>Returns whether a fraction is above the midpoint of a double and the next larger one. At the midpoint, it rounds to the even one.</summary>
        private static bool RoundsUp(BigInteger number, BigInteger divisor, long bits)
        {
            BigInteger midpoint = 2 * ((bits & (1L << 52) - 1) | (bits >> 52 == 0 ? 0 : 1L << 52)) + 1;
            var power = (int)Math.Max(bits >> 52, 1) - 1076;
            var order = power > 0 ? number.CompareTo((midpoint << power) * divisor) : (number << -power).CompareTo(midpoint * divisor);
            return order > 0 || order == 0 && bits % 2 == 1;
        }
    }
}
