using System;
using System.Collections.Generic;
using System.Globalization;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>How a replay stores and shows the values of a field.</summary>
    public enum ReplayFieldKind
    {
        /// <summary>Shown on a scale; stored in 65,534 steps of the range that it has in its segment.</summary>
        Number,

        /// <summary>A whole number that names something, such as an id: equal numbers have one colour. Stored exactly.</summary>
        Category,

        /// <summary>Red, green and blue as <c>0xRRGGBB</c>. Stored exactly.</summary>
        Colour,
    }

    /// <summary>A value that each node has in each frame, and that can colour it.</summary>
    public sealed class ReplayField
    {
        private const int MaxInteger = 1 << 30;

        // Categories with a colour in the order of their appearance.
        private const int MostInOrder = 256;

        private readonly HashSet<int> known = new HashSet<int>();
        private readonly JArray order = new JArray();

        /// <param name="name">Shown in the legend; different for each field.</param>
        /// <param name="kind">What the values are.</param>
        public ReplayField(string name, ReplayFieldKind kind = ReplayFieldKind.Number)
        {
            Name = name ?? throw new ArgumentNullException(nameof(name), "A field of the replay has no name.");
            Kind = kind;
        }

        public string Name { get; }
        public ReplayFieldKind Kind { get; }

        /// <summary>Unit of a number; null: none is shown.</summary>
        public string Unit { get; set; }

        /// <summary>Number at the lower end of the colours; null: the least of the recording.</summary>
        public float? Min { get; set; }

        /// <summary>Number at the upper end of the colours; null: the greatest of the recording.</summary>
        public float? Max { get; set; }

        /// <summary>What the categories 0, 1, ... are called; without a word a category is shown by its number.</summary>
        public IReadOnlyList<string> Categories { get; set; } = new string[0];

        internal double Least { get; private set; } = double.PositiveInfinity;
        internal double Greatest { get; private set; } = double.NegativeInfinity;
        internal bool SomeWithout { get; private set; }

        /// <summary>Returns why a value cannot be stored, or null if it can.</summary>
        internal string Refuse(double value)
        {
            if (double.IsNaN(value)) return null;
            if (double.IsInfinity(value)) return "an infinite " + Name;
            if (Kind == ReplayFieldKind.Number || value == Math.Floor(value) && Math.Abs(value) < MaxInteger) return null;
            return "the " + Name + " " + value.ToString("R", CultureInfo.InvariantCulture) + ", no whole number below 2^30";
        }

        /// <summary>Widens the field's range.</summary>
        internal void Include(double value)
        {
            if (double.IsNaN(value)) SomeWithout = true;
            else if (Kind == ReplayFieldKind.Category && known.Count < MostInOrder && known.Add((int)value)) order.Add((int)value);
            // Neither is true of NaN.
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
            // No value at all: no range either.
            json["least"] = Least <= Greatest ? Least : 0;
            json["greatest"] = Least <= Greatest ? Greatest : 0;
            json["someWithout"] = SomeWithout;
            return json;
        }
    }
}
