using System;
using System.Collections.Generic;
using System.Globalization;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>Kinds of fields, which determine how values are stored and shown.</summary>
    public enum ReplayFieldKind
    {
        /// <summary>Numbers on a scale. They are rounded to 65,534 steps of their range in a segment, unless all are whole.</summary>
        Number,

        /// <summary>Integers that identify a category, such as ids. Each has its own colour and is stored exactly.</summary>
        Category,

        /// <summary>Red, green and blue as <c>0xRRGGBB</c>. Stored exactly.</summary>
        Colour,
    }

    /// <summary>A value that nodes have in each frame, and by which they can be coloured.</summary>
    public sealed class ReplayField
    {
        internal const int MaxInteger = 1 << 30;

        // Number of categories whose order of appearance is stored for their colours.
        private const int MaxColouredCategories = 256;

        private readonly HashSet<int> categories = new HashSet<int>();
        private readonly JArray order = new JArray();

        /// <param name="name">Name in the legend, unique among the fields.</param>
        /// <param name="kind">Kind of the values.</param>
        public ReplayField(string name, ReplayFieldKind kind = ReplayFieldKind.Number)
        {
            Name = name ?? throw new ArgumentNullException(nameof(name), "A field of the replay has no name.");
            Kind = kind;
        }

        public string Name { get; }
        public ReplayFieldKind Kind { get; }

        /// <summary>Unit of a number, or null.</summary>
        public string Unit { get; set; }

        /// <summary>Value at the lower end of the colour scale, or null for the minimum in the recording.</summary>
        public float? Min { get; set; }

        /// <summary>Value at the upper end of the colour scale, or null for the maximum in the recording.</summary>
        public float? Max { get; set; }

        /// <summary>Names of the categories 0, 1, ... Other categories are shown as numbers.</summary>
        public IReadOnlyList<string> Categories { get; set; } = new string[0];

        internal double Least { get; private set; } = double.PositiveInfinity;
        internal double Greatest { get; private set; } = double.NegativeInfinity;
        internal bool HasMissingValues { get; private set; }

        /// <summary>Returns the reason why a value cannot be stored, or null if it can be stored.</summary>
        internal string FindProblem(double value)
        {
            if (double.IsNaN(value)) return null;
            if (double.IsInfinity(value)) return "an infinite " + Name;
            if (Kind == ReplayFieldKind.Number || value == Math.Floor(value) && Math.Abs(value) < MaxInteger) return null;
            return "the " + Name + " " + value.ToString("R", CultureInfo.InvariantCulture) + ", which is not a whole number below 2^30";
        }

        /// <summary>Extends the field's range to include a value.</summary>
        internal void Include(double value)
        {
            if (double.IsNaN(value)) HasMissingValues = true;
            else if (Kind == ReplayFieldKind.Category && categories.Count < MaxColouredCategories && categories.Add((int)value)) order.Add((int)value);
            // Both comparisons are false for NaN.
            if (value < Least) Least = value;
            if (value > Greatest) Greatest = value;
        }

        internal JObject ToJson()
        {
            var json = new JObject { ["name"] = Name, ["kind"] = Kind.ToString().ToLowerInvariant() };
            if (Unit != null) json["unit"] = Unit;
            if (Min.HasValue) json["min"] = ReplayMetadata.Number(Min.Value);
            if (Max.HasValue) json["max"] = ReplayMetadata.Number(Max.Value);
            if (Kind == ReplayFieldKind.Category) json["order"] = order;
            if (Categories.Count > 0) json["words"] = new JArray(Categories);
            // Without values, the range is 0 to 0.
            json["least"] = Least <= Greatest ? Least : 0;
            json["greatest"] = Least <= Greatest ? Greatest : 0;
            json["someWithout"] = HasMissingValues;
            return json;
        }
    }
}
