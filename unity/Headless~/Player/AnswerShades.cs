using System;
using System.Collections.Generic;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>Shades of the nodes' answers, for scenes without shades.</summary>
    internal static class AnswerShades
    {
        /// <summary>Each costs time and room in every frame.</summary>
        private const int MaxShades = 8;

        /// <summary>A shade for each number, truth value and enum of the answers; the first eight.</summary>
        internal static List<NodeShade> Of(SimulationManager manager)
        {
            var shades = new List<NodeShade>();
            foreach (var field in AnswerField.Of(manager))
            {
                if (shades.Count == MaxShades) break;
                if (Converter(field.Type) is Func<object, double> convert) shades.Add(Shade(field, convert));
            }
            return shades;
        }

        private static NodeShade Shade(AnswerField field, Func<object, double> convert)
        {
            var name = char.ToLowerInvariant(field.Name[0]) + field.Name.Substring(1);
            var shade = new NodeShade(name, node => node.Answer is object answer ? convert(field.Read(answer)) : double.NaN);
            if (field.Type == typeof(bool)) (shade.IsCategory, shade.Categories) = (true, new[] { "false", "true" });
            else if (field.Type.IsEnum) (shade.IsCategory, shade.Categories) = (true, Enum.GetNames(field.Type));
            return shade;
        }

        private static Func<object, double> Converter(Type type)
        {
            if (type == typeof(bool)) return value => (bool)value ? 1 : 0;
            if (type.IsEnum)
            {
                // In the same order as the names.
                var values = Enum.GetValues(type);
                return value => Array.IndexOf(values, value) is var place && place >= 0 ? place : double.NaN;
            }
            if (type.IsPrimitive && type != typeof(char)) return value => Storable(Convert.ToDouble(value));
            return null;
        }

        /// <summary>Infinity and greater numbers than a float holds, such as the distance to no source, count as no value: the page stores floats.</summary>
        private static double Storable(double value) => Math.Abs(value) <= float.MaxValue ? value : double.NaN;
    }
}
