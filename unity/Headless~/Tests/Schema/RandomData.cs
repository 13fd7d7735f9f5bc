using System;
using System.Reflection;
using Collektive.Bridge;

namespace Collektive.Headless.Tests.Schema
{
    /// <summary>Fills mirrors and drafts of any schema with random values, including edge cases.</summary>
    internal sealed class RandomData
    {
        private const int MaxNesting = 4;

        private readonly Random random;

        internal RandomData(int seed)
        {
            random = new Random(seed);
        }

        internal int Below(int limit) => random.Next(limit);

        internal T Mirror<T>() where T : unmanaged => (T)Value(typeof(T));

        internal void Fill(Draft draft, int nesting = 0)
        {
            draft.Clear();
            foreach (var field in draft.GetType().GetFields(BindingFlags.Public | BindingFlags.Instance))
            {
                // Let half of the scalars keep the schema's default.
                var set = Nullable.GetUnderlyingType(field.FieldType) != null || field.FieldType == typeof(string) || Coin();
                if (set) field.SetValue(draft, Value(field.FieldType));
                if (field.FieldType == typeof(string) && field.GetValue(draft) == null) field.SetValue(draft, Text());
            }
            foreach (var property in draft.GetType().GetProperties(BindingFlags.Public | BindingFlags.Instance))
            {
                var type = property.PropertyType;
                if (typeof(Draft).IsAssignableFrom(type))
                {
                    var required = property.Name == "Main";
                    if (!required && (nesting >= MaxNesting || Coin())) continue;
                    // The name of a property ends with an underscore if it would equal the name of its class.
                    Fill((Draft)draft.GetType().GetMethod("Make" + property.Name.TrimEnd('_')).Invoke(draft, null), nesting + 1);
                }
                else
                {
                    FillList(property.GetValue(draft), type, nesting);
                }
            }
        }

        private void FillList(object list, Type type, int nesting)
        {
            var add = type.GetMethod("Add");
            var count = nesting >= MaxNesting ? 0 : random.Next(4);
            for (var i = 0; i < count; i++)
            {
                if (type.GetGenericTypeDefinition() == typeof(DraftTables<>)) Fill((Draft)add.Invoke(list, null), nesting + 1);
                else add.Invoke(list, new[] { type.GenericTypeArguments[0] == typeof(string) ? Text() : Value(type.GenericTypeArguments[0]) });
            }
        }

        private object Value(Type type)
        {
            var optional = Nullable.GetUnderlyingType(type);
            if (optional != null) return Coin() ? null : Value(optional);
            if (type.IsEnum) return Enum.ToObject(type, Value(Enum.GetUnderlyingType(type)));
            if (type == typeof(string)) return Text();
            if (type == typeof(bool)) return Coin();
            if (type == typeof(float)) return Real((float)(random.NextDouble() * 2e3 - 1e3), float.MinValue, float.Epsilon);
            if (type == typeof(double)) return Real(random.NextDouble() * 2e3 - 1e3, double.MaxValue, -0.0);
            if (type.IsPrimitive) return Integer(type);
            var mirror = Activator.CreateInstance(type);
            foreach (var field in type.GetFields(BindingFlags.Public | BindingFlags.Instance)) field.SetValue(mirror, Value(field.FieldType));
            return mirror;
        }

        private object Integer(Type type)
        {
            switch (random.Next(4))
            {
                case 0: return type.GetField("MinValue").GetValue(null);
                case 1: return type.GetField("MaxValue").GetValue(null);
                default: return Convert.ChangeType(random.Next(100), type);
            }
        }

        private T Real<T>(T ordinary, T first, T second)
        {
            switch (random.Next(8))
            {
                case 0: return first;
                case 1: return second;
                default: return ordinary;
            }
        }

        private string Text()
        {
            var texts = new[] { "", "a", "node 7", "\u00e9t\u00e9", "\u6e2f", "\ud83d\ude80 up", new string('x', 300) };
            return texts[random.Next(texts.Length)];
        }

        private bool Coin() => random.Next(2) == 0;
    }
}
