using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using Collektive.Bridge;
using Collektive.Unity;

namespace Collektive.Headless
{
    /// <summary>A field of the answers of a scene's schema.</summary>
    internal sealed class AnswerField
    {
        private readonly MemberInfo member;

        private AnswerField(MemberInfo member, Type type)
        {
            this.member = member;
            Type = Nullable.GetUnderlyingType(type) ?? type;
        }

        /// <summary>Name in generated code. Its capitalisation differs from the name in the schema.</summary>
        internal string Name => member.Name;

        /// <summary>Type of the values. Optional fields may also be null.</summary>
        internal Type Type { get; }

        /// <summary>Returns the fields of the answers, in the order of the schema.</summary>
        internal static List<AnswerField> Of(DataSchema schema)
        {
            var buffer = schema.CreateActuators().GetType();
            while (!buffer.IsGenericType || buffer.GetGenericTypeDefinition() != typeof(ActuatorBuffer<>)) buffer = buffer.BaseType;
            var fields = new List<AnswerField>();
            foreach (var member in buffer.GetGenericArguments()[0].GetMembers(BindingFlags.Public | BindingFlags.Instance))
            {
                var type = TypeOf(member);
                if (type != null) fields.Add(new AnswerField(member, type));
            }
            return fields;
        }

        /// <summary>Returns the value of this field in an answer.</summary>
        /// <param name="answer">The answer of a node, not null.</param>
        internal object Read(object answer) => ValueOf(member, answer);

        /// <summary>Returns the type of a field or property; null for other members.</summary>
        internal static Type TypeOf(MemberInfo member) => member is FieldInfo field ? field.FieldType : (member as PropertyInfo)?.PropertyType;

        /// <summary>Returns the name in generated C# of a field with a name in the schema or in Kotlin.</summary>
        internal static string GeneratedName(string name) =>
            string.Concat(name.Split('_').Where(part => part.Length > 0).Select(part => char.ToUpperInvariant(part[0]) + part.Substring(1)));

        internal static object ValueOf(MemberInfo member, object owner) =>
            member is FieldInfo field ? field.GetValue(owner) : ((PropertyInfo)member).GetValue(owner);
    }
}
